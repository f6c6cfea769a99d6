#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/vec.h"

namespace gnomon::study {

/// The numbers that a key takes, both ends included unless said.
struct NumberRange {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool openBelow = false;  ///< `least` itself is not allowed
};

constexpr NumberRange anyNumber{};
constexpr NumberRange positive{0, std::numeric_limits<double>::infinity(), true};

/// The range in words: "a number above 0 and at most 1".
std::string expectedNumber(NumberRange range);

using KeyNames = std::set<std::string, std::less<>>;

/// A TOML table in which every key must be known: each function that reads a key checks its type
/// and range, and `finish` refuses the keys that were not read. `allow` refuses unknown keys before
/// anything is read, so that a mistyped key is reported as unknown and not as missing. All errors
/// are InputError and read `file:line: table.key: what was found, what was expected`.
class TomlReader {
 public:
  /// @param path  the table's place in the file, as `relief` or `light.2`; empty for the root
  TomlReader(const toml::table& table, std::string file, std::string path);

  [[nodiscard]] bool has(std::string_view key) const;
  /// The value of a key, which counts as read; null where there is none.
  [[nodiscard]] const toml::node* find(std::string_view key) const;
  /// The table or list of tables below a key; a missing one is an error, unless `optional` is in
  /// the name.
  [[nodiscard]] TomlReader table(std::string_view key) const;
  [[nodiscard]] std::optional<TomlReader> optionalTable(std::string_view key) const;
  [[nodiscard]] std::vector<TomlReader> tables(std::string_view key) const;
  [[nodiscard]] std::vector<TomlReader> optionalTables(std::string_view key) const;

  /// A string that is not empty.
  [[nodiscard]] std::string text(std::string_view key) const;
  /// The index of the value among `choices`.
  /// @param areNumbers  whether the choices are whole numbers in the file
  [[nodiscard]] std::size_t choice(std::string_view key, const std::vector<std::string>& choices,
                                   bool areNumbers = false) const;
  [[nodiscard]] bool flag(std::string_view key) const;
  [[nodiscard]] double number(std::string_view key, NumberRange range) const;
  [[nodiscard]] int integer(std::string_view key, int least, int most) const;
  /// A number, or a list of at least one.
  [[nodiscard]] std::vector<double> numbers(std::string_view key, NumberRange range) const;
  /// A list of so many numbers.
  [[nodiscard]] std::vector<double> list(std::string_view key, NumberRange range,
                                         std::size_t length) const;
  /// A list of points of three numbers.
  [[nodiscard]] std::vector<Vec3> points(std::string_view key) const;

  /// @throws InputError naming the first key that is none of these, and the nearest that is
  void allow(const KeyNames& keys) const;
  /// Refuses a table that has two of these keys, or none.
  void requireOneOf(const std::vector<std::string_view>& keys) const;
  void requireOneOf(std::string_view a, std::string_view b) const { requireOneOf({a, b}); }
  /// @throws InputError naming the first key that nobody read
  void finish() const;
  /// Refuses the value of a key for a reason of the caller's.
  [[noreturn]] void fail(std::string_view key, const std::string& what) const;
  /// Calls a library with values of this table and returns what it returns. Its InputError or
  /// MemoryError leaves as one about the key that has the name of the error's parameter; where the
  /// error names none, or the table has no such key, about `key`.
  template <typename Work>
  auto blame(std::string_view key, const Work& work) const -> decltype(work()) {
    try {
      return work();
    } catch (const InputError& error) {
      throw InputError(blamed(key, error));
    } catch (const MemoryError& error) {
      throw MemoryError(blamed(key, error));
    }
  }

  /// The table as the file and the overrides have it.
  [[nodiscard]] const toml::table& written() const { return *table_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  /// "file:line: table.key".
  [[nodiscard]] std::string placeOf(std::string_view key) const;
  /// The line of the file that this table begins in, from 1; 0 for one that an override made.
  [[nodiscard]] int line() const { return static_cast<int>(table_->source().begin.line); }

 private:
  [[nodiscard]] const toml::node& require(std::string_view key, std::string_view expected) const;
  [[nodiscard]] std::string place(const toml::node& node, std::string_view key) const;
  [[nodiscard]] std::string failure(std::string_view key, const std::string& what) const;
  [[nodiscard]] std::string blamed(std::string_view key, const Error& error) const;
  [[noreturn]] void refuseKey(const toml::node& node, std::string_view key,
                              const KeyNames& expected) const;
  [[noreturn]] void mismatch(const toml::node& node, std::string_view key,
                             const std::string& expected) const;
  [[nodiscard]] double checked(const toml::node& node, std::string_view key,
                               NumberRange range) const;
  [[nodiscard]] std::vector<double> listAt(const toml::node& node, std::string_view key,
                                           NumberRange range, std::size_t length) const;

  const toml::table* table_;
  std::string file_;
  std::string path_;
  mutable KeyNames read_;
};

/// Parses a TOML file and applies overrides.
/// @param overrides  `key.path=value`, as `relief.height=4` or `light.0.elevation=30`; the value is
///   TOML, or a string where it is not. A table that is not there yet is made; an entry of a list
///   must be there.
/// @throws InputError for a file that is missing or no TOML (with line and column); UsageError as
///   applyOverrides
toml::table parseToml(const std::filesystem::path& path,
                      const std::vector<std::string>& overrides = {});

/// As parseToml, with the file's text at hand.
/// @param file  as messages name it
toml::table parseTomlText(const std::string& text, const std::string& file,
                          const std::vector<std::string>& overrides = {});

/// Applies overrides in their order.
/// @throws UsageError for an override that is no UTF-8, without `=`, or whose path leads into
///   something that is not a table or list, or past a list's end
void applyOverrides(toml::table& table, const std::vector<std::string>& overrides);

/// A value in line, as a TOML file has it. Numbers have the fewest digits that read back to the
/// bit.
std::string tomlValueText(const toml::node& node);

/// A table as the text of a TOML file: its tables as `[key]`, its lists of tables as `[[key]]`, all
/// below them in line. Numbers have the fewest digits that read back to the bit (toml++ itself
/// writes 0.1 as 0.10000000000000001, and tables in alphabetical order).
/// @param order  keys that come first, in this order
/// @throws InputError where the text would not read back as the same table: TOML can hold no text
///   that is not UTF-8
std::string tomlText(const toml::table& table, const std::vector<std::string_view>& order = {});

}  // namespace gnomon::study
