#include "render/declaration.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "common/error.h"
#include "common/text.h"

namespace gnomon::render {

namespace {

/// What the first comment of a file declares, if it opens with the word.
std::optional<toml::table> declaredIn(const ShaderPiece& piece, std::string_view word) {
  const std::string opening = fmt::format("/* {}", word);
  const std::string_view text = piece.text;
  const std::size_t end = text.find("*/");
  if (!text.starts_with(opening) || end == std::string_view::npos) return std::nullopt;
  // The comment's opening takes the first line, so that TOML's line k is the file's line k.
  const std::string declared =
      std::string(opening.size(), ' ').append(text.substr(opening.size(), end - opening.size()));
  requireShallowToml(piece.file, declared);
  try {
    return toml::parse(declared, piece.file);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", piece.file, error.source().begin.line,
                                 oneLine(error.description())));
  }
}

/// Moves the nodes of a list behind those of another; of equal texts the first stays.
void join(toml::array& joined, toml::array& more) {
  for (toml::node& node : more) {
    const auto text = node.value<std::string_view>();
    const bool isThere =
        text && std::any_of(joined.begin(), joined.end(), [&](const toml::node& other) {
          return other.value<std::string_view>() == text;
        });
    if (!isThere) node.visit([&](auto& value) { joined.push_back(std::move(value)); });
  }
}

}  // namespace

Declaration::Declaration(const ShaderPiece& method, const std::vector<ShaderPiece>& includes) {
  for (const ShaderPiece& include : includes) files_.push_back(include.file);
  files_.push_back(method.file);
  constexpr std::string_view word = "gnomon-method";
  std::optional<toml::table> own = declaredIn(method, word);
  if (!own) {
    throw InputError(fmt::format(
        "{}:1: a comment `/* {} … */` with the method's declaration expected", method.file, word));
  }
  table_ = std::move(*own);
  std::vector<toml::table> parts;
  for (const ShaderPiece& include : includes) {
    if (auto part = declaredIn(include, "gnomon-part")) parts.push_back(std::move(*part));
  }
  for (const toml::table& part : parts) {
    allowOnly(part, {"tables", "passes", "pass", "bakes", "parameters"});
  }
  for (const char* key : {"tables", "passes", "pass"}) joinLists(key, parts);
  for (const char* key : {"bakes", "parameters"}) joinTables(key, parts);
}

void Declaration::joinLists(std::string_view key, std::vector<toml::table>& parts) {
  toml::array joined;
  for (toml::table& part : parts) {
    toml::node* list = part.get(key);
    if (list == nullptr) continue;
    if (!list->is_array()) fail(*list, fmt::format("`{}`: a list expected", key));
    join(joined, *list->as_array());
  }
  toml::node* own = table_.get(key);
  if (joined.empty() || (own != nullptr && !own->is_array())) return;
  if (own != nullptr) join(joined, *own->as_array());
  table_.insert_or_assign(key, std::move(joined));
}

void Declaration::joinTables(std::string_view key, std::vector<toml::table>& parts) {
  for (toml::table& part : parts) {
    toml::node* more = part.get(key);
    if (more == nullptr) continue;
    if (!more->is_table()) fail(*more, fmt::format("`{}`: a table expected", key));
    toml::node* own = table_.get(key);
    if (own == nullptr) {
      table_.insert(key, std::move(*more->as_table()));
      continue;
    }
    if (!own->is_table()) return;
    for (auto&& [name, node] : *more->as_table()) {
      // insert() leaves a table that is there.
      node.visit(
          [&, &named = name](auto& value) { own->as_table()->insert(named, std::move(value)); });
    }
  }
}

void Declaration::fail(const toml::node& node, const std::string& what) const {
  const toml::source_region& source = node.source();
  throw InputError(fmt::format("{}:{}: {}", source.path ? *source.path : files_.back(),
                               source.begin.line, what));
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
    throw InputError(fmt::format("{}:1: `{}` is missing, a string expected", files_.back(), key));
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

std::pair<std::size_t, std::size_t> Declaration::placeOf(const toml::node& node) const {
  const toml::source_region& source = node.source();
  const auto file =
      source.path ? std::find(files_.begin(), files_.end(), *source.path) : std::prev(files_.end());
  return {static_cast<std::size_t>(file - files_.begin()), source.begin.line};
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
