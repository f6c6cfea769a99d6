#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report/json/json_values.h"

namespace gnomon::report {

/// A JSON object with its place in a file, so that errors can name it: "FILE: results.3.tp: null
/// found, a number expected". It does not own the JSON.
class JsonReader {
 public:
  /// @param path  of the object in the file, with a dot at its end; empty for the file's own
  JsonReader(const Json& json, std::string file, std::string path);

  /// @throws InputError that names file and key
  [[noreturn]] void fail(const std::string& key, const std::string& what) const;

  /// The value of a key.
  /// @throws InputError where it is missing or of another type; also below
  [[nodiscard]] std::string text(const char* key) const;
  [[nodiscard]] double number(const char* key) const;
  /// None for null.
  [[nodiscard]] std::optional<double> numberOrNull(const char* key) const;
  [[nodiscard]] JsonReader object(const char* key) const;
  [[nodiscard]] std::vector<JsonReader> list(const char* key) const;
  [[nodiscard]] std::vector<std::string> texts(const char* key) const;
  [[nodiscard]] bool flag(const char* key) const;
  [[nodiscard]] bool has(const char* key) const;
  /// Whether the key is there with the value null.
  [[nodiscard]] bool isNull(const char* key) const;

 private:
  [[nodiscard]] const Json& at(const char* key, const char* expected,
                               bool (Json::*isRight)() const noexcept) const;

  const Json* json_;
  std::string file_;
  std::string path_;
};

/// @throws InputError for a file that cannot be read, is no JSON, or has a key twice in one object
///   (the JSON standard leaves open which of them counts), naming the line
Json readJson(const std::filesystem::path& path);

}  // namespace gnomon::report
