#include "common/text/toml_nesting.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"

namespace gnomon {
namespace {

/// The length of a string that `text` begins with, both its quotation marks included; all of the
/// text where the string does not end. One of a single mark ends with its line.
std::size_t stringLength(std::string_view text) {
  const char mark = text.front();
  const bool isMultiline = text.size() > 2 && text[1] == mark && text[2] == mark;
  const std::size_t marks = isMultiline ? 3 : 1;
  std::size_t inARow = 0;
  for (std::size_t i = marks; i < text.size(); ++i) {
    if (!isMultiline && text[i] == '\n') return i;
    if (mark == '"' && text[i] == '\\' && i + 1 < text.size() && text[i + 1] != '\n') {
      ++i;
      inARow = 0;
      continue;
    }
    inARow = text[i] == mark ? inARow + 1 : 0;
    if (inARow < marks) continue;
    // Of five marks in a row the last three end the string.
    std::size_t end = i + 1;
    while (isMultiline && end < text.size() && end <= i + 2 && text[end] == mark) ++end;
    return end;
  }
  return text.size();
}

}  // namespace

std::optional<int> tooDeepTomlLine(std::string_view text) {
  int line = 1;
  int brackets = 0;
  int dots = 0;  // since whatever ends a key
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const std::string_view string = text.substr(i, stringLength(text.substr(i)));
      line += static_cast<int>(std::count(string.begin(), string.end(), '\n'));
      i += string.size() - 1;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '[' || c == '{') {
      dots = 0;
      if (++brackets > mostTomlNesting) return line;
    } else if (c == ']' || c == '}') {
      brackets = std::max(0, brackets - 1);
    } else if (c == '.') {
      if (++dots >= mostTomlNesting) return line;
    } else if (c == '=' || c == ',' || c == '\n') {
      dots = 0;
      line += c == '\n' ? 1 : 0;
    }
  }
  return std::nullopt;
}

void requireShallowToml(const std::string& file, std::string_view text) {
  const auto line = tooDeepTomlLine(text);
  if (!line) return;
  throw InputError(
      fmt::format("{}:{}: nested too deep, at most {} brackets or parts of a key expected", file,
                  *line, mostTomlNesting));
}

}  // namespace gnomon
