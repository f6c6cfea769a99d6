#include "report/tables/formats/terminal_format.h"

#include <algorithm>
#include <span>

#include "report/text/text_width.h"

namespace gnomon::report {
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
