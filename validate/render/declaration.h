#pragma once

#include <toml++/toml.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::render {

/// The declaration of a method: the TOML in the first comment of its GLSL file. What is wrong with
/// it is an InputError that names the file and the line there.
class Declaration {
 public:
  /// @throws InputError where the text does not open with one
  Declaration(std::string file, std::string_view text);

  [[nodiscard]] const toml::table& table() const { return table_; }
  [[noreturn]] void fail(const toml::node& node, const std::string& what) const;
  void allowOnly(const toml::table& table, std::initializer_list<std::string_view> keys) const;

  /// A text that must be there.
  [[nodiscard]] std::string text(std::string_view key) const;
  [[nodiscard]] std::string textOf(const toml::node& node, std::string_view key) const;
  /// A finite number that must be there.
  [[nodiscard]] double number(const toml::table& table, std::string_view key) const;
  [[nodiscard]] double numberOf(const toml::node& node, std::string_view key) const;
  /// A whole number within a range; nothing where the key is not there.
  [[nodiscard]] std::optional<int> count(const toml::table& table, std::string_view key, int least,
                                         int most) const;
  /// Whether a filter is "linear", as without the key, or "nearest".
  [[nodiscard]] bool isLinear(const toml::table& table, std::string_view key) const;
  /// `about` of a table; empty where it has none.
  [[nodiscard]] std::string about(const toml::table& table) const;

 private:
  std::string file_;
  toml::table table_;
};

/// Whether a name can be that of a table, a texture or a pass of a method's own: others are made
/// from it. At most 40 letters and digits, the first a small letter.
bool isOwnName(std::string_view name);

/// @throws InputError for a name that is none
void requireOwnName(const Declaration& declaration, const toml::node& node, std::string_view what,
                    std::string_view name);

/// The name with a capital first letter.
std::string capitalised(std::string name);

}  // namespace gnomon::render
