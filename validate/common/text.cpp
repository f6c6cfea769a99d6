#include "common/text.h"

#include <fmt/core.h>
#include <utf8proc.h>

#include <algorithm>
#include <vector>

#include "common/error.h"

namespace gnomon {

namespace {

std::size_t mistakes(std::string_view a, std::string_view b) {
  // cost[i][j] turns the first i letters of a into the first j of b.
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const std::size_t wrong = a[i - 1] == b[j - 1] ? 0 : 1;
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + wrong});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> nearestName(std::string_view typed,
                                       const std::set<std::string, std::less<>>& names) {
  // A long text is no slip of the fingers, and the table above grows with its square.
  constexpr std::size_t longest = 64;
  constexpr std::size_t fewestLetters = 3;  // of a name that was cut off
  if (typed.size() > longest) return std::nullopt;
  std::optional<std::string> nearest;
  std::size_t fewest = 0;
  for (const std::string& name : names) {
    const std::size_t count = mistakes(typed, name);
    if (nearest ? count >= fewest : 3 * count > name.size()) continue;
    nearest = name;
    fewest = count;
  }
  if (nearest || typed.size() < fewestLetters) return nearest;
  for (const std::string& name : names) {
    const bool isShorter = !nearest || name.size() < nearest->size();
    if (name.starts_with(typed) && isShorter) nearest = name;
  }
  return nearest;
}

std::string oneLine(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character character = firstCharacter(text);
    if (!character.valid || reversesText(character.code)) {
      line += "\uFFFD";
    } else if (isControl(character.code)) {
      line += ' ';
    } else {
      line += text.substr(0, character.bytes);
    }
    text.remove_prefix(character.bytes);
  }
  return line;
}

namespace {

bool isPlain(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || std::string_view("_@%+=:,./-").find(c) != std::string_view::npos;
}

}  // namespace

std::string shellQuoted(std::string_view word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), isPlain)) return std::string(word);
  std::string text = "'";
  for (const char c : word) {
    if (c == '\'') {
      text += "'\\''";
    } else {
      text += c;
    }
  }
  return text + "'";
}

Utf8Character firstCharacter(std::string_view text) {
  utf8proc_int32_t code = 0;
  const utf8proc_ssize_t bytes =
      utf8proc_iterate(reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
                       static_cast<utf8proc_ssize_t>(text.size()), &code);
  if (bytes < 1) return {};
  return {static_cast<std::uint32_t>(code), static_cast<std::size_t>(bytes), true};
}

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    const Utf8Character character = firstCharacter(text);
    if (!character.valid) return false;
    text.remove_prefix(character.bytes);
  }
  return true;
}

bool isControl(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029;
}

bool reversesText(std::uint32_t code) {
  return (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

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
