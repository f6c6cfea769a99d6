#include "study/spec/suite/suite_text.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "common/error.h"

namespace gnomon::study {
namespace {

std::string suiteString(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
      continue;
    }
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string suiteKey(std::string_view key) {
  const bool isBare = key.find_first_not_of(
                          "abcdefghijklmnopqrstuvwxyz"
                          "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string_view::npos &&
                      !key.empty();
  return isBare ? std::string(key) : suiteString(key);
}

/// A float keeps its point, so that it does not read back as an integer.
std::string suiteFloat(double value) {
  std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string suiteValue(const toml::node& node) {
  if (const auto* text = node.as_string()) return suiteString(text->get());
  if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = node.as_floating_point()) return suiteFloat(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  std::vector<std::string> entries;
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      entries.push_back(fmt::format("{} = {}", suiteKey(key.str()), suiteValue(value)));
    }
    return fmt::format("{{ {} }}", fmt::join(entries, ", "));
  }
  if (const auto* array = node.as_array()) {
    for (const toml::node& entry : *array) entries.push_back(suiteValue(entry));
    const bool isNested = !array->empty() && array->front().is_array();
    return isNested ? fmt::format("[\n  {},\n]", fmt::join(entries, ",\n  "))
                    : fmt::format("[{}]", fmt::join(entries, ", "));
  }
  throw InputError("a date or time found, which no key of a study is");
}

std::string suiteSection(const std::string& heading, const toml::table& section) {
  std::string text = heading + "\n";
  for (const auto& [key, value] : section) {
    text += fmt::format("{} = {}\n", suiteKey(key.str()), suiteValue(value));
  }
  return text;
}

}  // namespace

std::string suiteText(const toml::table& study, const std::vector<std::string_view>& order) {
  std::vector<std::string> sections;
  for (const std::string_view name : order) {
    const toml::node* node = study.get(name);
    if (node == nullptr) continue;
    if (const auto* table = node->as_table()) {
      sections.push_back(suiteSection(fmt::format("[{}]", name), *table));
      continue;
    }
    for (const toml::node& entry : *node->as_array()) {
      sections.push_back(suiteSection(fmt::format("[[{}]]", name), *entry.as_table()));
    }
  }
  return fmt::format("{}", fmt::join(sections, "\n"));
}

}  // namespace gnomon::study
