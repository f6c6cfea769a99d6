#include "report/text/text_width.h"

#include <locale.h>
#include <wchar.h>

#include <algorithm>
#include <utility>

#include "common/error.h"
#include "common/text/utf8.h"

namespace gnomon {
namespace {

/// Lets this thread read UTF-8 whatever the user's locale is, and only as long as it lives.
class Utf8Scope {
 public:
  Utf8Scope() : utf8_(newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)) {
    if (utf8_ == nullptr) throw InternalError("locale: the system has no C.UTF-8");
    previous_ = uselocale(utf8_);
  }
  ~Utf8Scope() {
    uselocale(previous_);
    freelocale(utf8_);
  }
  Utf8Scope(const Utf8Scope&) = delete;
  Utf8Scope& operator=(const Utf8Scope&) = delete;

 private:
  locale_t utf8_;
  locale_t previous_{};
};

struct Glyph {
  std::string_view bytes;
  std::size_t width = 1;
};

/// The first character of `text` (not empty), and how many bytes of it were read.
std::pair<Glyph, std::size_t> firstGlyph(std::string_view text) {
  wchar_t character = 0;
  mbstate_t state{};
  const std::size_t length = mbrtowc(&character, text.data(), text.size(), &state);
  const bool invalid =
      length == static_cast<std::size_t>(-1) || length == static_cast<std::size_t>(-2);
  if (invalid) return {{"\uFFFD", 1}, 1};
  const auto code = static_cast<std::uint32_t>(character);
  if (turnsDirection(code)) return {{"\uFFFD", 1}, length};
  const int cells = wcwidth(character);
  if (length == 0 || cells < 0 || isControl(code))
    return {{"?", 1}, std::max<std::size_t>(length, 1)};
  return {{text.substr(0, length), static_cast<std::size_t>(cells)}, length};
}

std::vector<Glyph> glyphsOf(std::string_view text) {
  const Utf8Scope scope;
  std::vector<Glyph> glyphs;
  while (!text.empty()) {
    const auto [glyph, length] = firstGlyph(text);
    glyphs.push_back(glyph);
    text.remove_prefix(length);
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

}  // namespace gnomon
