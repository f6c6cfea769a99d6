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

/// Where a comment that begins at a place ends; the place itself where none begins.
std::size_t endOfComment(std::string_view glsl, std::size_t at) {
  if (glsl.substr(at, 2) == "//") return std::min(glsl.find('\n', at), glsl.size());
  if (glsl.substr(at, 2) != "/*") return at;
  const std::size_t close = glsl.find("*/", at + 2);
  return close == std::string_view::npos ? glsl.size() : close + 2;
}

/// The first place from `at` on that is no space and in no comment.
std::size_t nextCode(std::string_view glsl, std::size_t at) {
  while (at < glsl.size()) {
    const std::size_t end = endOfComment(glsl, at);
    if (end == at && std::string_view(" \t\r\n\\").find(glsl[at]) == std::string_view::npos) break;
    at = std::max(end, at + 1);
  }
  return at;
}

/// The place after the parenthesis that closes the one at a place; npos where none does.
std::size_t afterParentheses(std::string_view glsl, std::size_t open) {
  int depth = 0;
  for (std::size_t at = open; at < glsl.size();) {
    const std::size_t end = endOfComment(glsl, at);
    if (end == at) depth += glsl[at] == '(' ? 1 : (glsl[at] == ')' ? -1 : 0);
    at = std::max(end, at + 1);
    if (depth == 0) return at;
  }
  return std::string_view::npos;
}

/// The head of a loop, "for (…)" or "while (…)", so that `nextTurn()` can end it.
/// @param isLast  whether nothing but a semicolon follows: the end of `do`, or a loop without body
std::string endingHead(std::string_view word, std::string_view parentheses, bool isLast) {
  if (word == "while" && isLast) return fmt::format("while ({} && nextTurn())", parentheses);
  return fmt::format("{} {} if (!nextTurn()) break; else", word, parentheses);
}

/// Where a comment or a line of the preprocessor that begins at a place ends; the place itself
/// where none begins.
std::size_t endOfNoCode(std::string_view glsl, std::size_t at) {
  return glsl[at] == '#' ? std::min(glsl.find('\n', at), glsl.size()) : endOfComment(glsl, at);
}

}  // namespace

std::optional<std::size_t> lineOfWord(std::string_view glsl, std::string_view word) {
  std::size_t line = 1;
  for (std::size_t at = 0; at < glsl.size();) {
    std::size_t end = std::max(endOfComment(glsl, at), at + 1);
    if (isWordCharacter(glsl[at])) {
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

std::string withEndingLoops(std::string_view glsl) {
  std::string text;
  for (std::size_t at = 0; at < glsl.size();) {
    std::size_t end = std::max(endOfComment(glsl, at), at + 1);
    if (isWordCharacter(glsl[at])) {
      while (end < glsl.size() && isWordCharacter(glsl[end])) ++end;
    }
    const std::string_view word = glsl.substr(at, end - at);
    const std::size_t open = nextCode(glsl, end);
    const bool isHead = (word == "for" || word == "while") && glsl.substr(open, 1) == "(";
    const std::size_t close = isHead ? afterParentheses(glsl, open) : std::string_view::npos;
    if (close == std::string_view::npos) {
      text += word;
      at = end;
      continue;
    }
    const bool isLast = glsl.substr(nextCode(glsl, close), 1) == ";";
    text += endingHead(word, glsl.substr(open, close - open), isLast);
    at = close;
  }
  return text;
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
