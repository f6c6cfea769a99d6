#include "report/text/text_width.h"

#include <utf8proc.h>

#include <algorithm>
#include <utility>

#include "common/text.h"

namespace gnomon::report {

namespace {

struct Glyph {
  std::string_view bytes;
  std::size_t width = 1;
};

/// A character as a terminal may be given it.
Glyph glyphOf(const Utf8Character& character, std::string_view bytes) {
  if (!character.valid || reversesText(character.code)) return {"\uFFFD", 1};
  const auto code = static_cast<utf8proc_int32_t>(character.code);
  const bool isAssigned = utf8proc_category(code) != UTF8PROC_CATEGORY_CN;
  if (!isAssigned || isControl(character.code)) return {"?", 1};
  return {bytes, static_cast<std::size_t>(utf8proc_charwidth(code))};
}

std::vector<Glyph> glyphsOf(std::string_view text) {
  std::vector<Glyph> glyphs;
  while (!text.empty()) {
    const Utf8Character character = firstCharacter(text);
    glyphs.push_back(glyphOf(character, text.substr(0, character.bytes)));
    text.remove_prefix(character.bytes);
  }
  return glyphs;
}

std::size_t widthOf(const std::vector<Glyph>& glyphs) {
  std::size_t width = 0;
  for (const Glyph& glyph : glyphs) width += glyph.width;
  return width;
}

struct Line {
  std::string text;
  std::size_t width = 0;

  void append(const Glyph& glyph) {
    text += glyph.bytes;
    width += glyph.width;
  }
};

/// As much of the text as `width` columns hold.
Line fitted(std::string_view text, std::size_t width) {
  const std::vector<Glyph> glyphs = glyphsOf(text);
  const bool whole = widthOf(glyphs) <= width;
  const std::size_t room = whole || width == 0 ? width : width - 1;
  Line line;
  for (const Glyph& glyph : glyphs) {
    if (line.width + glyph.width > room) break;
    line.append(glyph);
  }
  if (!whole && width > 0) line.append({"…", 1});
  return line;
}

std::vector<std::string_view> wordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

}  // namespace

std::size_t displayWidth(std::string_view text) {
  return widthOf(glyphsOf(text));
}

std::string terminalText(std::string_view text) {
  std::string plain;
  for (const Glyph& glyph : glyphsOf(text)) plain += glyph.bytes;
  return plain;
}

std::string fitLeft(std::string_view text, std::size_t width) {
  const Line line = fitted(text, width);
  return line.text + std::string(width - line.width, ' ');
}

std::string fitRight(std::string_view text, std::size_t width) {
  const Line line = fitted(text, width);
  return std::string(width - line.width, ' ') + line.text;
}

std::vector<std::string> wrapText(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  Line line;
  const auto breakLine = [&] {
    if (!line.text.empty()) lines.push_back(std::exchange(line, {}).text);
  };
  for (const std::string_view word : wordsOf(text)) {
    const std::vector<Glyph> glyphs = glyphsOf(word);
    if (line.width > 0 && line.width + 1 + widthOf(glyphs) > width) breakLine();
    if (line.width > 0) line.append({" ", 1});
    for (const Glyph& glyph : glyphs) {
      if (line.width > 0 && line.width + glyph.width > width) breakLine();
      line.append(glyph);
    }
  }
  breakLine();
  return lines;
}

namespace {

bool isXml(std::uint32_t code) {
  if (isControl(code)) return code == '\t' || code == '\n' || code == '\r';
  return code != 0xFFFE && code != 0xFFFF;
}

}  // namespace

std::string xmlText(std::string_view text) {
  std::string clean;
  clean.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character character = firstCharacter(text);
    const bool stays = character.valid && isXml(character.code) && !reversesText(character.code);
    clean += stays ? text.substr(0, character.bytes) : "\uFFFD";
    text.remove_prefix(character.bytes);
  }
  return clean;
}

}  // namespace gnomon::report
