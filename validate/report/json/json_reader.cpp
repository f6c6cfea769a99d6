#include "report/json/json_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/text/one_line.h"

namespace gnomon::report {

JsonReader::JsonReader(const Json& json, std::string file, std::string path)
    : json_(&json), file_(std::move(file)), path_(std::move(path)) {}

void JsonReader::fail(const std::string& key, const std::string& what) const {
  throw InputError(fmt::format("{}: {}{}: {}", file_, path_, key, oneLine(what)));
}

const Json& JsonReader::at(const char* key, const char* expected,
                           bool (Json::*isRight)() const noexcept) const {
  if (!has(key)) fail(key, fmt::format("missing, {} expected", expected));
  const Json& value = json_->at(key);
  if (!(value.*isRight)()) {
    fail(key, fmt::format("{} found, {} expected", value.type_name(), expected));
  }
  return value;
}

bool JsonReader::has(const char* key) const {
  return json_->is_object() && json_->contains(key);
}

bool JsonReader::isNull(const char* key) const {
  return has(key) && json_->at(key).is_null();
}

bool JsonReader::flag(const char* key) const {
  return at(key, "true or false", &Json::is_boolean).get<bool>();
}

std::string JsonReader::text(const char* key) const {
  return at(key, "a string", &Json::is_string).get<std::string>();
}

double JsonReader::number(const char* key) const {
  return at(key, "a number", &Json::is_number).get<double>();
}

std::optional<double> JsonReader::numberOrNull(const char* key) const {
  if (isNull(key)) return std::nullopt;
  return number(key);
}

JsonReader JsonReader::object(const char* key) const {
  return {at(key, "an object", &Json::is_object), file_, path_ + key + "."};
}

std::vector<std::string> JsonReader::texts(const char* key) const {
  std::vector<std::string> entries;
  for (const Json& entry : at(key, "a list", &Json::is_array)) {
    if (!entry.is_string()) fail(key, "a list of strings expected");
    entries.push_back(entry.get<std::string>());
  }
  return entries;
}

std::vector<JsonReader> JsonReader::list(const char* key) const {
  std::vector<JsonReader> entries;
  for (const Json& entry : at(key, "a list", &Json::is_array)) {
    entries.emplace_back(entry, file_, fmt::format("{}{}.{}.", path_, key, entries.size()));
  }
  return entries;
}

Json readJson(const std::filesystem::path& path) {
  const std::string text = readFile(path);
  std::istringstream stream(text);          // it tells how far the parser has come
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto refuseSecond = [&](int, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed).second) {
      const auto line = 1 + std::count(text.begin(), text.begin() + stream.tellg(), '\n');
      throw InputError(fmt::format("{}:{}: {}: a second time in one object, one expected",
                                   path.string(), line, oneLine(parsed.dump())));
    }
    return true;
  };
  try {
    return Json::parse(stream, refuseSecond);
  } catch (const Json::parse_error& error) {
    const auto read = static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), text.begin() + read, '\n');
    throw InputError(fmt::format("{}:{}: no JSON: {}", path.string(), line, error.what()));
  } catch (const Json::exception& error) {
    // A number that no double holds.
    throw InputError(fmt::format("{}: no JSON: {}", path.string(), error.what()));
  }
}

}  // namespace gnomon::report
