#include "report/terminal_page.h"

#include <fmt/core.h>
#include <utf8proc.h>

#include <algorithm>
#include <span>
#include <utility>

#include "common/text.h"
#include "report/text/number_text.h"

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

namespace {

const char* verdictColour(study::Verdict verdict) {
  return verdict == study::Verdict::held ? "32" : verdict == study::Verdict::failed ? "31" : "33";
}

/// Where the next `ESC [ DIGITS m` begins: what changes colour and face, and nothing else.
std::size_t styleAt(std::string_view text) {
  constexpr std::string_view begin = "\x1b[";
  for (std::size_t at = text.find(begin); at != text.npos; at = text.find(begin, at + 1)) {
    const std::size_t end = text.find_first_not_of("0123456789", at + begin.size());
    if (end != text.npos && end > at + begin.size() && text[end] == 'm') return at;
  }
  return text.npos;
}

}  // namespace

void TerminalPage::line(std::string_view text) {
  while (!text.empty()) {
    const std::size_t style = colours_ ? styleAt(text) : std::string_view::npos;
    const std::size_t plain = std::min(style, text.size());
    text_ += terminalText(text.substr(0, plain));
    text.remove_prefix(plain);
    if (text.empty()) break;
    const std::size_t length = text.find('m') + 1;
    text_ += text.substr(0, length);
    text.remove_prefix(length);
  }
  text_ += '\n';
}

void TerminalPage::paragraph(std::string_view text, std::size_t margin) {
  for (const std::string& part : wrapText(text, terminalWidth - margin)) {
    line(std::string(margin, ' ') + part);
  }
}

void TerminalPage::heading(std::string_view text) {
  for (const std::string& part : wrapText(text, terminalWidth)) line(styled(part, "1"));
}

std::string TerminalPage::styled(const std::string& text, const char* code) const {
  const std::string plain = terminalText(text);
  return colours_ ? fmt::format("\x1b[{}m{}\x1b[0m", code, plain) : plain;
}

void TerminalPage::notices(const std::vector<std::string>& texts) {
  if (!texts.empty()) blank();
  for (const std::string& text : texts) paragraph("Notice: " + text);
}

void TerminalPage::fault(const std::string& label, std::string_view text) {
  line(std::string(terminalIndent, ' ') + styled(label, "31"));
  paragraph(text, 2 * terminalIndent);
}

void TerminalPage::met(const std::string& title, std::size_t all,
                       const std::vector<std::string>& failed) {
  if (all == 0) return;
  blank();
  heading(fmt::format("{}: {} of {} met", title, all - failed.size(), all));
  for (const std::string& text : failed) fault("failed", text);
}

void TerminalPage::claims(const std::vector<study::ClaimRecord>& records) {
  if (records.empty()) return;
  constexpr std::size_t margin = terminalIndent + 21;
  blank();
  heading("Claims");
  for (const study::ClaimRecord& claim : records) {
    const std::string verdict = fitLeft(study::verdictName(claim.verdict), margin - terminalIndent);
    std::vector<std::string> lines = wrapText(claim.text, terminalWidth - margin);
    if (lines.empty()) lines.emplace_back();
    line(std::string(terminalIndent, ' ') + styled(verdict, verdictColour(claim.verdict)) +
         lines.front());
    for (std::size_t i = 1; i < lines.size(); ++i) line(std::string(margin, ' ') + lines[i]);
    paragraph(claim.detail, margin);
  }
}

namespace {

/// Between a text and what stands before it.
constexpr std::size_t textGap = 2;
/// The columns that all texts of a row have at least, if they need as many.
constexpr std::size_t leastTexts = 30;

/// A column as a terminal shows it.
struct Lane {
  std::size_t column = 0;
  bool isText = false;
  std::size_t width = 0;  ///< without the gap before a text, with the gap before a figure
};

/// So wide that the figures of a table stand under each other in all its blocks.
std::size_t usualWidth(Quantity quantity) {
  switch (quantity) {
    case Quantity::percent:
      return 7;
    case Quantity::signedPercent:
      return 11;
    case Quantity::interval:
      return 17;
    case Quantity::bytes:
      return 12;
    case Quantity::count:
      return 13;
    default:
      return 0;
  }
}

std::string figureWithMark(const Column& column, const Cell& cell) {
  return cellText(column.quantity, cell) + (column.markWidth == 0 ? cell.mark : "");
}

std::size_t widthOf(const Table& table, std::size_t index) {
  const Column& column = table.columns[index];
  const bool text = isText(column.quantity);
  const std::size_t usual = std::max(column.width, usualWidth(column.quantity));
  const std::size_t gap = text ? 0 : usual > 0 ? 1 : textGap;
  const std::size_t headGap = text ? 0 : textGap;
  std::size_t width = std::max(usual, displayWidth(heading(column)) + headGap);
  for (const Row& row : table.rows) {
    width = std::max(width, displayWidth(figureWithMark(column, row.cells[index])) + gap);
  }
  return width;
}

/// Columns of a block, with the marks behind their figures and the gaps before their texts.
std::size_t totalWidth(const Table& table, std::span<const Lane> lanes) {
  std::size_t width = 0;
  for (const Lane& lane : lanes) {
    width += lane.width + table.columns[lane.column].markWidth;
    if (lane.isText && lane.column != lanes.front().column) width += textGap;
  }
  return width;
}

/// Cuts the widest text until all of them fit.
void shrinkTexts(std::vector<Lane>& lanes, std::size_t excess) {
  const auto wider = [](const Lane& a, const Lane& b) {
    return (a.isText ? a.width : 0) < (b.isText ? b.width : 0);
  };
  for (; excess > 0; --excess) {
    Lane& widest = *std::max_element(lanes.begin(), lanes.end(), wider);
    if (widest.isText && widest.width > 0) --widest.width;
  }
}

/// The columns in blocks that fit into `room`: a block has all texts and as many figures as fit.
std::vector<std::vector<Lane>> blocksOf(const Table& table, std::vector<Lane> lanes,
                                        std::size_t room) {
  std::size_t texts = 0;
  for (const Lane& lane : lanes) texts += lane.isText ? lane.width : 0;
  const std::size_t all = totalWidth(table, lanes);
  const std::size_t spare = texts - std::min(texts, leastTexts);
  shrinkTexts(lanes, std::min(spare, all - std::min(all, room)));
  std::vector<std::vector<Lane>> blocks;
  std::vector<Lane> names;
  std::copy_if(lanes.begin(), lanes.end(), std::back_inserter(names),
               [](const Lane& lane) { return lane.isText; });
  if (totalWidth(table, lanes) <= room) return {lanes};
  for (const Lane& lane : lanes) {
    if (lane.isText) continue;
    if (!blocks.empty()) {
      blocks.back().push_back(lane);
      if (totalWidth(table, blocks.back()) <= room) continue;
      blocks.back().pop_back();
    }
    blocks.push_back(names);
    blocks.back().push_back(lane);
  }
  if (blocks.empty()) blocks.push_back(names);
  return blocks;
}

const char* colourOf(Emphasis emphasis) {
  switch (emphasis) {
    case Emphasis::good:
      return "32";
    case Emphasis::bad:
      return "31";
    case Emphasis::open:
      return "33";
    default:
      return nullptr;
  }
}

/// A line of a block. `textOf(column)` is a text, `markOf(column)` what stands behind it.
template <typename TextOf, typename MarkOf>
std::string lineOf(const Table& table, std::span<const Lane> lanes, const TextOf& textOf,
                   const MarkOf& markOf) {
  std::string line(terminalIndent, ' ');
  for (const Lane& lane : lanes) {
    if (lane.isText && lane.column != lanes.front().column) line += std::string(textGap, ' ');
    line += textOf(lane);
    const std::size_t room = table.columns[lane.column].markWidth;
    if (room > 0) line += fitLeft(markOf(lane), room);
  }
  return line;
}

std::string withoutEndSpaces(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

std::string fitted(const Lane& lane, const std::string& text) {
  return lane.isText ? fitLeft(text, lane.width) : fitRight(text, lane.width);
}

std::string rowLine(const TerminalPage& page, const Table& table, const Row& row,
                    std::span<const Lane> lanes) {
  return lineOf(
      table, lanes,
      [&](const Lane& lane) {
        const Cell& cell = row.cells[lane.column];
        const std::string text = fitted(lane, figureWithMark(table.columns[lane.column], cell));
        const char* colour = colourOf(cell.emphasis);
        return colour == nullptr ? text : page.styled(text, colour);
      },
      [&](const Lane& lane) { return row.cells[lane.column].mark; });
}

/// How far a row's name stands in.
std::size_t nameMargin(const Table& table, std::span<const Lane> lanes) {
  std::size_t margin = terminalIndent;
  for (const Lane& lane : lanes) {
    if (table.columns[lane.column].quantity == Quantity::name) break;
    margin += lane.width + textGap;
  }
  return margin;
}

void appendBlock(TerminalPage& page, const Table& table, std::span<const Lane> lanes) {
  const std::string head = withoutEndSpaces(lineOf(
      table, lanes,
      [&](const Lane& lane) { return fitted(lane, heading(table.columns[lane.column])); },
      [](const Lane&) { return ""; }));
  if (!head.empty()) page.line(head);
  bool isApart = false;
  for (const Row& row : table.rows) {
    if (row.isApart && !isApart) page.paragraph(table.apart, terminalIndent);
    isApart = row.isApart;
    page.line(withoutEndSpaces(rowLine(page, table, row, lanes) + row.mark));
    if (!row.remark.empty()) page.paragraph(row.remark, nameMargin(table, lanes));
  }
}

}  // namespace

void appendTable(TerminalPage& page, const Table& table) {
  std::vector<Lane> lanes;
  for (const std::size_t i : columnsFor(table, onTerminal)) {
    lanes.push_back({i, isText(table.columns[i].quantity), widthOf(table, i)});
  }
  if (lanes.empty()) return;
  std::size_t marks = 0;
  for (const Row& row : table.rows) marks = std::max(marks, displayWidth(row.mark));
  const auto blocks = blocksOf(table, std::move(lanes), terminalWidth - terminalIndent - marks);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (i > 0) page.blank();
    appendBlock(page, table, blocks[i]);
  }
  for (const std::string& note : table.notes) page.paragraph(note, terminalIndent);
}

std::string terminalTable(const Table& table) {
  TerminalPage page(false);
  appendTable(page, table);
  return page.text();
}

}  // namespace gnomon::report
