#include "render/glsl_text.h"

#include <fmt/core.h>

#include <algorithm>

namespace gnomon::render {
namespace {

bool isWordCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Whether parentheses that hold a word follow a place.
bool parenthesesHold(std::string_view glsl, std::size_t at, std::string_view word) {
  const std::size_t open = std::min(glsl.find_first_not_of(" \t\r\n", at), glsl.size());
  const std::string_view inside = glsl.substr(open, glsl.find(')', open) - open);
  return inside.starts_with('(') && lineOfWord(inside, word);
}

/// Where a comment or a line of the preprocessor that begins at a place ends; the place itself
/// where none begins.
std::size_t endOfNoCode(std::string_view glsl, std::size_t at) {
  if (glsl.substr(at, 2) == "//" || glsl[at] == '#')
    return std::min(glsl.find('\n', at), glsl.size());
  if (glsl.substr(at, 2) != "/*") return at;
  const std::size_t close = glsl.find("*/", at + 2);
  return close == std::string_view::npos ? glsl.size() : close + 2;
}

}  // namespace

std::optional<std::size_t> lineOfWord(std::string_view glsl, std::string_view word) {
  std::size_t line = 1;
  for (std::size_t at = 0; at < glsl.size();) {
    std::size_t end = at + 1;
    if (glsl.substr(at, 2) == "//") {
      end = std::min(glsl.find('\n', at), glsl.size());
    } else if (glsl.substr(at, 2) == "/*") {
      const std::size_t close = glsl.find("*/", at + 2);
      end = close == std::string_view::npos ? glsl.size() : close + 2;
    } else if (isWordCharacter(glsl[at])) {
      while (end < glsl.size() && isWordCharacter(glsl[end])) ++end;
      if (glsl.substr(at, end - at) == word) return line;
    }
    line +=
        static_cast<std::size_t>(std::count(glsl.begin() + static_cast<std::ptrdiff_t>(at),
                                            glsl.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at = end;
  }
  return std::nullopt;
}

bool definesFunction(std::string_view glsl, std::string_view name, std::string_view argument) {
  int depth = 0;  // of braces
  for (std::size_t at = 0; at < glsl.size();) {
    std::size_t end = endOfNoCode(glsl, at);
    if (end == at) {
      ++end;
      depth += glsl[at] == '{' ? 1 : (glsl[at] == '}' ? -1 : 0);
    }
    if (isWordCharacter(glsl[at])) {
      while (end < glsl.size() && isWordCharacter(glsl[end])) ++end;
      const bool isName = depth == 0 && glsl.substr(at, end - at) == name;
      if (isName && parenthesesHold(glsl, end, argument)) return true;
    }
    at = end;
  }
  return false;
}

bool definesFunction(const std::vector<ShaderPiece>& code, std::string_view name,
                     std::string_view argument) {
  return std::any_of(code.begin(), code.end(), [&](const ShaderPiece& piece) {
    return definesFunction(piece.text, name, argument);
  });
}

std::optional<std::string> placeOfWord(const std::vector<ShaderPiece>& code,
                                       std::string_view word) {
  for (const ShaderPiece& piece : code) {
    const auto line = lineOfWord(piece.text, word);
    if (line) return fmt::format("{}:{}", piece.file, piece.firstLine + *line - 1);
  }
  return std::nullopt;
}

}  // namespace gnomon::render
