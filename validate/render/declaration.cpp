#include "render/declaration.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <utility>

#include "common/error.h"
#include "common/text/one_line.h"
#include "common/text/toml_nesting.h"

namespace gnomon::render {

Declaration::Declaration(std::string file, std::string_view text) : file_(std::move(file)) {
  constexpr std::string_view opening = "/* gnomon-method";
  const std::size_t begin = text.find(opening);
  const std::size_t end = text.find("*/");
  if (begin != 0 || end == std::string_view::npos) {
    throw InputError(fmt::format("{}:1: a comment `{} … */` with the method's declaration expected",
                                 file_, opening));
  }
  // The comment's opening takes the first line, so that TOML's line k is the file's line k.
  const std::string declared =
      std::string(opening.size(), ' ').append(text.substr(opening.size(), end - opening.size()));
  requireShallowToml(file_, declared);
  try {
    table_ = toml::parse(declared);
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: {}", file_, error.source().begin.line, oneLine(error.description())));
  }
}

void Declaration::fail(const toml::node& node, const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", file_, node.source().begin.line, what));
}

void Declaration::allowOnly(const toml::table& table,
                            std::initializer_list<std::string_view> keys) const {
  for (const auto& [key, node] : table) {
    if (std::find(keys.begin(), keys.end(), key.str()) == keys.end()) {
      fail(node, fmt::format("unknown key `{}`, expected {}", key.str(), fmt::join(keys, ", ")));
    }
  }
}

std::string Declaration::text(std::string_view key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    throw InputError(fmt::format("{}:1: `{}` is missing, a string expected", file_, key));
  }
  return textOf(*node, key);
}

std::string Declaration::textOf(const toml::node& node, std::string_view key) const {
  const auto value = node.value_exact<std::string>();
  if (!value) fail(node, fmt::format("`{}`: a string expected", key));
  return *value;
}

double Declaration::number(const toml::table& table, std::string_view key) const {
  const toml::node* node = table.get(key);
  if (node == nullptr) fail(table, fmt::format("`{}` is missing, a number expected", key));
  return numberOf(*node, key);
}

double Declaration::numberOf(const toml::node& node, std::string_view key) const {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value)) {
    fail(node, fmt::format("`{}`: a finite number expected", key));
  }
  return *value;
}

std::optional<int> Declaration::count(const toml::table& table, std::string_view key, int least,
                                      int most) const {
  const toml::node* found = table.get(key);
  if (found == nullptr) return std::nullopt;
  const auto value = found->value_exact<std::int64_t>();
  if (!value || *value < least || *value > most) {
    fail(*found, fmt::format("`{}`: a whole number from {} to {} expected", key, least, most));
  }
  return static_cast<int>(*value);
}

bool Declaration::isLinear(const toml::table& table, std::string_view key) const {
  const toml::node* found = table.get(key);
  if (found == nullptr) return true;
  const auto name = found->value_exact<std::string>().value_or("");
  if (name != "linear" && name != "nearest") {
    fail(*found, fmt::format("`{}`: linear or nearest expected", key));
  }
  return name == "linear";
}

std::string Declaration::about(const toml::table& table) const {
  const toml::node* node = table.get("about");
  return node == nullptr ? "" : textOf(*node, "about");
}

bool isOwnName(std::string_view name) {
  const auto isLetter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  return !name.empty() && name.size() <= 40 &&
         std::islower(static_cast<unsigned char>(name.front())) != 0 &&
         std::all_of(name.begin(), name.end(), isLetter);
}

void requireOwnName(const Declaration& declaration, const toml::node& node, std::string_view what,
                    std::string_view name) {
  if (isOwnName(name)) return;
  declaration.fail(node, fmt::format("{} `{}`: a name of at most 40 letters and digits that begins "
                                     "with a small letter expected",
                                     what, name));
}

std::string capitalised(std::string name) {
  if (!name.empty()) {
    name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  }
  return name;
}

}  // namespace gnomon::render
