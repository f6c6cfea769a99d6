#include "study/spec/toml_reader.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "common/files/atomic_file.h"
#include "common/text.h"

namespace gnomon::study {
namespace {

std::string describe(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>())
    return fmt::format("the string \"{}\"", *text);
  if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
  if (const auto whole = node.value_exact<std::int64_t>()) return fmt::format("{}", *whole);
  if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
  if (node.is_table()) return "a table";
  if (node.is_array()) return fmt::format("a list of {}", node.as_array()->size());
  return "a date or time";
}

}  // namespace

std::string expectedNumber(NumberRange range) {
  const bool bounded = std::isfinite(range.most);
  if (std::isfinite(range.least) && bounded) {
    return fmt::format("a number {} {} and at most {}", range.openBelow ? "above" : "of at least",
                       range.least, range.most);
  }
  if (std::isfinite(range.least)) {
    return fmt::format("a number {} {}", range.openBelow ? "above" : "of at least", range.least);
  }
  return bounded ? fmt::format("a number of at most {}", range.most) : "a finite number";
}

TomlReader::TomlReader(const toml::table& table, std::string file, std::string path)
    : table_(&table), file_(std::move(file)), path_(std::move(path)) {}

bool TomlReader::has(std::string_view key) const {
  return table_->contains(key);
}

const toml::node* TomlReader::find(std::string_view key) const {
  read_.emplace(key);
  return table_->get(key);
}

std::string TomlReader::place(const toml::node& node, std::string_view key) const {
  const auto line = node.source().begin.line;
  const std::string name = path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
  return line > 0 ? fmt::format("{}:{}: {}", file_, line, name)
                  : fmt::format("{}: {}", file_, name);
}

const toml::node& TomlReader::require(std::string_view key, std::string_view expected) const {
  const toml::node* node = find(key);
  if (node == nullptr) {
    throw InputError(fmt::format("{}: missing, {} expected", place(*table_, key), expected));
  }
  return *node;
}

void TomlReader::mismatch(const toml::node& node, std::string_view key,
                          const std::string& expected) const {
  throw InputError(
      fmt::format("{}: {} found, {} expected", place(node, key), describe(node), expected));
}

std::string TomlReader::placeOf(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return place(node != nullptr ? *node : *table_, key);
}

std::string TomlReader::failure(std::string_view key, const std::string& what) const {
  return fmt::format("{}: {}", placeOf(key), what);
}

std::string TomlReader::blamed(std::string_view key, const Error& error) const {
  const bool isKey = !error.parameter().empty() && table_->get(error.parameter()) != nullptr;
  return failure(isKey ? std::string_view(error.parameter()) : key, error.reason());
}

void TomlReader::fail(std::string_view key, const std::string& what) const {
  throw InputError(failure(key, what));
}

void TomlReader::requireOneOf(const std::vector<std::string_view>& keys) const {
  std::vector<std::string_view> found;
  for (const std::string_view key : keys) {
    if (has(key)) found.push_back(key);
  }
  if (found.size() > 1) {
    fail(found[1], fmt::format("`{}` found beside it, one of the two expected", found[0]));
  }
  if (found.empty()) {
    fail(keys.front(), fmt::format("missing, either `{}` expected", fmt::join(keys, "` or `")));
  }
}

void TomlReader::refuseKey(const toml::node& node, std::string_view key,
                           const KeyNames& expected) const {
  const auto nearest = nearestName(key, expected);
  throw InputError(fmt::format("{}: unknown key, expected {}{}", place(node, key),
                               fmt::join(expected, ", "),
                               nearest ? fmt::format(". Did you mean `{}`?", *nearest) : ""));
}

void TomlReader::allow(const KeyNames& keys) const {
  for (const auto& [key, node] : *table_) {
    if (!keys.contains(key.str())) refuseKey(node, key.str(), keys);
  }
}

void TomlReader::finish() const {
  for (const auto& [key, node] : *table_) {
    if (!read_.contains(key.str())) refuseKey(node, key.str(), read_);
  }
}

TomlReader TomlReader::table(std::string_view key) const {
  const toml::node& node = require(key, fmt::format("a table [{}]", key));
  if (!node.is_table()) mismatch(node, key, "a table");
  return {*node.as_table(), file_,
          path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key)};
}

std::optional<TomlReader> TomlReader::optionalTable(std::string_view key) const {
  if (find(key) == nullptr) return std::nullopt;
  return table(key);
}

std::vector<TomlReader> TomlReader::tables(std::string_view key) const {
  const std::string expected = fmt::format("at least one [[{}]]", key);
  const toml::node& node = require(key, expected);
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) mismatch(node, key, expected);
  std::vector<TomlReader> result;
  for (const toml::node& entry : *array) {
    if (!entry.is_table()) mismatch(entry, key, expected);
    const std::string name = fmt::format("{}.{}", key, result.size());
    result.emplace_back(*entry.as_table(), file_, path_.empty() ? name : path_ + "." + name);
  }
  return result;
}

std::vector<TomlReader> TomlReader::optionalTables(std::string_view key) const {
  if (find(key) == nullptr) return {};
  return tables(key);
}

std::string TomlReader::text(std::string_view key) const {
  const toml::node& node = require(key, "a string");
  const auto value = node.value_exact<std::string>();
  if (!value || value->empty()) mismatch(node, key, "a string that is not empty");
  return *value;
}

std::size_t TomlReader::choice(std::string_view key, const std::vector<std::string>& choices,
                               bool areNumbers) const {
  const std::string expected = fmt::format("one of {}", fmt::join(choices, ", "));
  const toml::node& node = require(key, expected);
  std::optional<std::string> value = node.value_exact<std::string>();
  if (areNumbers) {
    const auto whole = node.value_exact<std::int64_t>();
    value = whole ? std::optional(fmt::format("{}", *whole)) : std::nullopt;
  }
  const auto found = std::find(choices.begin(), choices.end(), value);
  if (found == choices.end()) mismatch(node, key, expected);
  return static_cast<std::size_t>(found - choices.begin());
}

bool TomlReader::flag(std::string_view key) const {
  const toml::node& node = require(key, "true or false");
  const auto value = node.value_exact<bool>();
  if (!value) mismatch(node, key, "true or false");
  return *value;
}

double TomlReader::checked(const toml::node& node, std::string_view key, NumberRange range) const {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  const bool inside = value && std::isfinite(*value) && *value >= range.least &&
                      *value <= range.most && !(range.openBelow && *value == range.least);
  if (!inside) mismatch(node, key, expectedNumber(range));
  return *value;
}

double TomlReader::number(std::string_view key, NumberRange range) const {
  return checked(require(key, expectedNumber(range)), key, range);
}

int TomlReader::integer(std::string_view key, int least, int most) const {
  const std::string expected = fmt::format("a whole number from {} to {}", least, most);
  const toml::node& node = require(key, expected);
  const auto value = node.value_exact<std::int64_t>();
  if (!value || *value < least || *value > most) mismatch(node, key, expected);
  return static_cast<int>(*value);
}

std::vector<double> TomlReader::list(std::string_view key, NumberRange range,
                                     std::size_t length) const {
  return listAt(require(key, fmt::format("a list of {} numbers", length)), key, range, length);
}

std::vector<double> TomlReader::listAt(const toml::node& node, std::string_view key,
                                       NumberRange range, std::size_t length) const {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != length) {
    mismatch(node, key, fmt::format("a list of {} numbers", length));
  }
  std::vector<double> values;
  for (const toml::node& entry : *array) values.push_back(checked(entry, key, range));
  return values;
}

std::vector<double> TomlReader::numbers(std::string_view key, NumberRange range) const {
  const toml::node& node = require(key, "a number or a list of numbers");
  const toml::array* array = node.as_array();
  if (array == nullptr) return {checked(node, key, range)};
  if (array->empty()) mismatch(node, key, "a number or a list of at least one");
  return listAt(node, key, range, array->size());
}

std::vector<Vec3> TomlReader::points(std::string_view key) const {
  const toml::node& node = require(key, "a list of points");
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) mismatch(node, key, "a list of points");
  std::vector<Vec3> points;
  for (const toml::node& entry : *array) {
    const auto values = listAt(entry, key, anyNumber, 3);
    points.emplace_back(values[0], values[1], values[2]);
  }
  return points;
}

namespace {

std::vector<std::string> splitPath(std::string_view path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= path.size()) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    parts.emplace_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// The value as TOML reads it, or else the text itself as a string.
toml::table parsedValue(const std::string& text) {
  try {
    toml::table table = toml::parse("value = " + text);
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {
    // Not TOML: text.
  }
  return toml::table{{"value", text}};
}

/// What a part of a path leads to; null where there is no such thing.
toml::node* child(toml::node& node, const std::string& part) {
  if (toml::table* table = node.as_table()) {
    // A table that is not there yet is made: an override may add a whole section.
    if (!table->contains(part)) table->insert(part, toml::table{});
    return table->get(part);
  }
  toml::array* array = node.as_array();
  std::size_t index = 0;
  const auto [end, failure] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (array == nullptr || failure != std::errc() || end != part.data() + part.size())
    return nullptr;
  return array->get(index);
}

void applyOverride(toml::table& root, const std::string& text) {
  if (!isUtf8(text)) throw UsageError(fmt::format("--set {}: UTF-8 expected", text));
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw UsageError(fmt::format("--set {}: KEY=VALUE expected, as relief.height=4", text));
  }
  std::vector<std::string> parts = splitPath(std::string_view(text).substr(0, equals));
  if (parts.size() > mostTomlNesting || tooDeepTomlLine(text)) {
    throw UsageError(
        fmt::format("--set {}…: nested too deep, at most {} brackets or parts of a key expected",
                    text.substr(0, 40), mostTomlNesting));
  }
  const toml::table value = parsedValue(text.substr(equals + 1));
  const std::string last = parts.back();
  parts.pop_back();
  toml::node* node = &root;
  std::string path;
  for (const std::string& part : parts) {
    const toml::array* list = node->as_array();
    toml::node* next = child(*node, part);
    if (next == nullptr) {
      const std::string entries =
          list != nullptr ? fmt::format(", {} has {} counted from 0", path, list->size()) : "";
      path += path.empty() ? part : "." + part;
      throw UsageError(fmt::format("--set {}: there is no `{}`{}", text, path, entries));
    }
    path += path.empty() ? part : "." + part;
    node = next;
  }
  toml::table* table = node->as_table();
  if (table == nullptr || last.empty()) {
    throw UsageError(fmt::format("--set {}: `{}` is no key of a table", text, last));
  }
  value.get("value")->visit([&](const auto& concrete) { table->insert_or_assign(last, concrete); });
}

}  // namespace

void applyOverrides(toml::table& table, const std::vector<std::string>& overrides) {
  for (const std::string& change : overrides) applyOverride(table, change);
}

toml::table parseToml(const std::filesystem::path& path,
                      const std::vector<std::string>& overrides) {
  return parseTomlText(readFile(path), path.string(), overrides);
}

toml::table parseTomlText(const std::string& text, const std::string& file,
                          const std::vector<std::string>& overrides) {
  requireShallowToml(file, text);
  try {
    toml::table table = toml::parse(text, file);
    applyOverrides(table, overrides);
    return table;
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}:{}: {}", file, error.source().begin.line,
                                 error.source().begin.column, oneLine(error.description())));
  }
}

namespace {

std::string keyText(std::string_view key) {
  const auto isBare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), isBare);
  return bare ? std::string(key) : fmt::format("\"{}\"", key);
}

/// A float keeps its point, so that it does not read back as an integer.
std::string numberText(double value) {
  std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string arrayText(const toml::array& array) {
  std::vector<std::string> entries;
  for (const toml::node& entry : array) entries.push_back(tomlValueText(entry));
  const bool isNested = !array.empty() && array.front().is_array();
  return isNested ? fmt::format("[\n  {},\n]", fmt::join(entries, ",\n  "))
                  : fmt::format("[{}]", fmt::join(entries, ", "));
}

std::string inlineText(const toml::table& table) {
  std::vector<std::string> entries;
  for (const auto& [key, node] : table) {
    entries.push_back(fmt::format("{} = {}", keyText(key.str()), tomlValueText(node)));
  }
  return fmt::format("{{ {} }}", fmt::join(entries, ", "));
}

}  // namespace

std::string tomlValueText(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) return numberText(number->get());
  if (const auto* array = node.as_array()) return arrayText(*array);
  if (const auto* table = node.as_table()) return inlineText(*table);
  std::ostringstream text;
  node.visit([&text](const auto& value) { text << value; });
  return text.str();
}

namespace {

std::string bodyText(const toml::table& table) {
  std::string text;
  for (const auto& [key, node] : table) {
    text += fmt::format("{} = {}\n", keyText(key.str()), tomlValueText(node));
  }
  return text;
}

std::string sectionText(std::string_view key, const toml::node& node) {
  if (const auto* table = node.as_table()) {
    return fmt::format("[{}]\n{}\n", keyText(key), bodyText(*table));
  }
  std::string text;
  for (const toml::node& entry : *node.as_array()) {
    text += fmt::format("[[{}]]\n{}\n", keyText(key), bodyText(*entry.as_table()));
  }
  return text;
}

bool isSection(const toml::node& node) {
  return node.is_table() || node.is_array_of_tables();
}

bool readsBack(const std::string& text, const toml::table& table) {
  try {
    return toml::parse(text) == table;
  } catch (const toml::parse_error&) {
    return false;
  }
}

}  // namespace

std::string tomlText(const toml::table& table, const std::vector<std::string_view>& order) {
  std::string text;
  for (const auto& [key, node] : table) {
    if (!isSection(node)) text += fmt::format("{} = {}\n", keyText(key.str()), tomlValueText(node));
  }
  for (const std::string_view key : order) {
    const toml::node* node = table.get(key);
    if (node != nullptr && isSection(*node)) text += sectionText(key, *node);
  }
  for (const auto& [key, node] : table) {
    const bool isWritten = std::find(order.begin(), order.end(), key.str()) != order.end();
    if (isSection(node) && !isWritten) text += sectionText(key.str(), node);
  }
  if (!readsBack(text, table)) {
    throw InputError("a name or path is no UTF-8 text, which TOML cannot hold");
  }
  // Sections are parted by an empty line; the last needs none.
  if (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace gnomon::study
