#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/shader_files.h"

namespace gnomon::render {

/// The declaration of a method: the TOML in the first comment of its GLSL file, together with what
/// the files that it includes declare. What is wrong with it is an InputError that names the file
/// and the line there.
///
/// An included file declares what its functions need in a first comment that opens with
/// `gnomon-part`: `tables`, `passes`, [[pass]], [bakes.NAME], [parameters.NAME]. Lists are joined;
/// a text stands in them once. Passes and bakes of included files come before the method's own,
/// which may read them. A table of the method stands in place of an included file's of the same
/// name, and of two included files the one that is included first decides.
class Declaration {
 public:
  /// @param includes  in the order in which they are included
  /// @throws InputError where the method's text does not open with one
  Declaration(const ShaderPiece& method, const std::vector<ShaderPiece>& includes);

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
  /// Where a node stands among all that is declared: its file, in the order above, and its line.
  [[nodiscard]] std::pair<std::size_t, std::size_t> placeOf(const toml::node& node) const;
  /// `about` of a table; empty where it has none.
  [[nodiscard]] std::string about(const toml::table& table) const;

 private:
  void joinLists(std::string_view key, std::vector<toml::table>& parts);
  void joinTables(std::string_view key, std::vector<toml::table>& parts);

  std::vector<std::string> files_;  ///< that are included, then the method's own
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
