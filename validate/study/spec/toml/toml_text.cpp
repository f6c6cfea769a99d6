#include "study/spec/toml/toml_text.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "common/error.h"

namespace gnomon::study {
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
