#include "report/tables/latex_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "common/text.h"

namespace gnomon::report {

const char* paperWidthName(PaperWidth width) {
  return width == PaperWidth::column ? "column" : "page";
}

double millimetresOf(PaperWidth width) {
  return width == PaperWidth::column ? 84 : 178;
}

TabularRoom roomOf(PaperWidth width, double fontSize) {
  return {width == PaperWidth::column ? inColumn : onPaper,
          millimetresOf(width) * pointsOfMillimetre, fontSize};
}

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 31> signs = {{
    {"\\", "\\textbackslash{}"},
    {"&", "\\&"},
    {"%", "\\%"},
    {"$", "\\$"},
    {"#", "\\#"},
    {"_", "\\_"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"~", "\\textasciitilde{}"},
    {"^", "\\textasciicircum{}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"|", "\\textbar{}"},
    // Not \textquotedbl, which the encoding OT1 lacks.
    {"\"", "\\char34{}"},
    {"–", "--"},
    {"--", "-{}-{}"},
    {"’", "'"},
    // Not \textdegree, which has no outlines in the usual fonts.
    {"°", "$^\\circ$"},
    {"×", "$\\times$"},
    {"≈", "$\\approx$"},
    {"−", "$-$"},
    {"≤", "$\\leq$"},
    {"≥", "$\\geq$"},
    {"±", "$\\pm$"},
    {"κ", "$\\kappa$"},
    {"Δ", "$\\Delta$"},
    {"ρ", "$\\rho$"},
    {"…", "\\dots{}"},
    {"\u202f", "\\,"},
    {"\u00a0", "~"},
    {"→", "$\\to$"},
}};

/// One line; LaTeX refuses U+FFFD.
std::string knownText(std::string_view text) {
  std::string line = oneLine(text);
  constexpr std::string_view unknown = "\uFFFD";
  for (std::size_t at = 0; (at = line.find(unknown, at)) != std::string::npos;) {
    line.replace(at, unknown.size(), 1, '?');
  }
  return line;
}

/// The wider of the two fonts, a character of each kind.
double characterWidth(std::uint32_t code) {
  if (code == 0x202f) return 0.17;
  if (code == 0xa0) return 0.34;
  if (code == 0x2026) return 1.38;
  if (code > 0x7f) return code < 0x2e80 ? 0.78 : 1.0;
  const char c = static_cast<char>(code);
  const auto isOneOf = [&](std::string_view characters) {
    return characters.find(c) != std::string_view::npos;
  };
  if (isOneOf("ijl.,:;!|'")) return 0.29;
  if (c == ' ') return 0.35;
  if (isOneOf("ftr-()[]/")) return 0.4;
  if (isOneOf("MW%@")) return 1.06;
  if (isOneOf("mw<>+=~&#")) return 0.86;
  if (c >= 'A' && c <= 'Z') return 0.81;
  return c >= '0' && c <= '9' ? 0.514 : 0.54;
}

}  // namespace

std::string escapeLatex(std::string_view asked) {
  const std::string clean = knownText(asked);
  std::string_view text = clean;
  std::string latex;
  // After the end of a row they would be that command's own.
  const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
  if (first < text.size() && (text[first] == '[' || text[first] == '*')) {
    latex = fmt::format("{{{}}}", text[first]);
    text.remove_prefix(first + 1);
  }
  while (!text.empty()) {
    std::size_t length = 1;
    std::string_view written = text.substr(0, 1);
    for (const auto& [sign, command] : signs) {
      if (!text.starts_with(sign)) continue;
      length = sign.size();
      written = command;
      break;
    }
    latex += written;
    text.remove_prefix(length);
  }
  return latex;
}

double latexWidth(std::string_view text) {
  double width = 0;
  const std::string clean = knownText(text);
  for (std::string_view rest = clean; !rest.empty();) {
    const Utf8Character character = firstCharacter(rest);
    width += characterWidth(character.code);
    rest.remove_prefix(character.bytes);
  }
  return width;
}

std::string cutText(const std::string& text, double width) {
  if (latexWidth(text) <= width) return text;
  const double room = width - latexWidth("…");
  std::string cut;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t bytes = firstCharacter(rest).bytes;
    const std::string longer = cut + std::string(rest.substr(0, bytes));
    if (latexWidth(longer) > room) break;
    cut = longer;
    rest.remove_prefix(bytes);
  }
  return cut + "…";
}

std::vector<std::string> breakableParts(std::string_view text) {
  constexpr std::string_view ends = " -/_,:";
  std::vector<std::string> parts;
  bool hasEnded = true;
  for (const char c : text) {
    const bool isEnd = ends.find(c) != std::string_view::npos;
    if (parts.empty() || (hasEnded && !isEnd)) parts.emplace_back();
    parts.back() += c;
    hasEnded = isEnd;
  }
  return parts;
}

namespace {

// Lengths are in units of the font's size.
constexpr double leastGap = 0.6;
constexpr double mostGap = 1.4;
constexpr double leastText = 4.5;  ///< of a column of texts that are broken

/// "≈" of " ≈", with a space at which no line is broken.
std::string markBefore(std::string_view mark) {
  mark.remove_prefix(std::min(mark.find_first_not_of(' '), mark.size()));
  return mark.empty() ? "" : std::string(mark) + "\u00a0";
}

/// An interval with a dash, unless one of its ends has a sign.
std::string shortInterval(const std::string& text) {
  const std::size_t word = text.find(" to ");
  const bool isSigned = text.find("−") != std::string::npos;
  return word == std::string::npos || isSigned ? text : std::string(text).replace(word, 4, "–");
}

/// A cell's text with its marks, before it is escaped.
std::string shownText(const Column& column, const Cell& cell, const Row& row, Readers reader) {
  const std::string mark = column.quantity == Quantity::name ? markBefore(row.mark) : "";
  const std::string text = cellText(column.quantity, cell);
  const bool isShort = column.quantity == Quantity::interval && reader == inColumn;
  return mark + (isShort ? shortInterval(text) : text) + cell.mark;
}

std::string headOf(const Column& column, Readers reader) {
  return reader == inColumn && !column.shortName.empty() ? column.shortName : heading(column);
}

double widestPart(const std::string& text) {
  double widest = 0;
  for (const std::string& part : breakableParts(text)) widest = std::max(widest, latexWidth(part));
  return widest;
}

/// The text in lines no wider than `width`, if its parts are no wider.
std::vector<std::string> linesOf(const std::string& text, double width) {
  std::vector<std::string> lines;
  for (const std::string& part : breakableParts(text)) {
    if (lines.empty() || latexWidth(lines.back()) + latexWidth(part) > width + 1e-9) {
      lines.emplace_back();
    }
    lines.back() += part;
  }
  return lines;
}

/// How the columns of a reader are set.
struct Layout {
  Readers reader;
  std::vector<std::size_t> columns;
  std::vector<double> widths;
  std::vector<bool> isBroken;  ///< texts are broken into lines
  bool hasBrokenHeads = false;
  double gap = leastGap;

  /// With the gaps between its columns.
  [[nodiscard]] double width() const {
    const double gaps = columns.empty() ? 0 : gap * static_cast<double>(columns.size() - 1);
    return std::accumulate(widths.begin(), widths.end(), gaps);
  }
};

/// Takes what is too much from the widest columns of texts.
void narrowTexts(const Table& table, double room, Layout& layout) {
  const auto isWider = [&](std::size_t a, std::size_t b) {
    return layout.widths[a] < layout.widths[b];
  };
  std::vector<std::size_t> texts;
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    if (isText(table.columns[layout.columns[i]].quantity)) texts.push_back(i);
  }
  constexpr double step = 0.1;
  while (!texts.empty() && layout.width() > room) {
    const std::size_t widest = *std::max_element(texts.begin(), texts.end(), isWider);
    if (layout.widths[widest] - step < leastText) return;
    layout.widths[widest] -= step;
    layout.isBroken[widest] = true;
  }
}

Layout layoutOf(const Table& table, const TabularRoom& room) {
  const double most = room.width / room.fontSize;
  Layout layout{room.reader, columnsFor(table, room.reader), {}, {}};
  layout.isBroken.assign(layout.columns.size(), false);
  std::vector<double> broken;  // with headings in lines
  for (const std::size_t i : layout.columns) {
    double width = 0;
    for (const Row& row : table.rows) {
      width =
          std::max(width, latexWidth(shownText(table.columns[i], row.cells[i], row, room.reader)));
    }
    const std::string head = headOf(table.columns[i], room.reader);
    layout.widths.push_back(std::max(width, latexWidth(head)));
    broken.push_back(std::max(width, widestPart(head)));
  }
  if (layout.width() > most) {
    layout.widths = broken;
    layout.hasBrokenHeads = true;
  }
  narrowTexts(table, most, layout);
  if (layout.columns.size() > 1) {
    const auto gaps = static_cast<double>(layout.columns.size() - 1);
    layout.gap = std::clamp(leastGap + (most - layout.width()) / gaps, leastGap, mostGap);
  }
  return layout;
}

std::string brokenCell(const std::string& text, double width) {
  std::string cell;
  for (const std::string& part : breakableParts(text)) {
    // LaTeX itself breaks lines behind a space and a hyphen.
    const bool isOpen = !cell.empty() && cell.back() != ' ' && cell.back() != '-';
    cell += (isOpen ? "\\allowbreak{}" : "") + escapeLatex(cutText(part, width));
  }
  return "\\raggedright\\hangindent=0.8em " + cell;
}

std::string columnSpecs(const Table& table, const TabularRoom& room, const Layout& layout) {
  std::string specs = "@{}";
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    if (i > 0) specs += fmt::format("@{{\\hspace{{{:.1f}pt}}}}", layout.gap * room.fontSize);
    const bool isLeft = isText(table.columns[layout.columns[i]].quantity);
    specs += layout.isBroken[i] ? fmt::format("p{{{:.1f}pt}}", layout.widths[i] * room.fontSize)
             : isLeft           ? "l"
                                : "r";
  }
  return specs + "@{}";
}

/// The rows of the headings: a heading ends in the last.
std::string headRows(const Table& table, const Layout& layout) {
  std::vector<std::vector<std::string>> heads;
  std::size_t most = 1;
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    const std::string head = headOf(table.columns[layout.columns[i]], layout.reader);
    const double width = std::max(layout.widths[i], widestPart(head));
    heads.push_back(layout.hasBrokenHeads ? linesOf(head, width) : std::vector{head});
    most = std::max(most, heads.back().size());
  }
  std::string rows;
  for (std::size_t line = 0; line < most; ++line) {
    std::string row;
    for (const std::vector<std::string>& head : heads) {
      const std::size_t blank = most - head.size();
      row += row.empty() ? "  " : " & ";
      if (line >= blank) row += escapeLatex(head[line - blank]);
    }
    rows += row + " \\\\\n";
  }
  return rows;
}

std::string bodyRow(const Table& table, const Layout& layout, const Row& row) {
  std::string line;
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    const std::size_t at = layout.columns[i];
    const std::string text = shownText(table.columns[at], row.cells[at], row, layout.reader);
    line += line.empty() ? "  " : " & ";
    line += layout.isBroken[i] ? brokenCell(text, layout.widths[i]) : escapeLatex(text);
  }
  return line + " \\\\\n";
}

std::string comment(const std::string& text) {
  return text.empty() ? "" : "% " + oneLine(text) + "\n";
}

/// What a caption may say.
std::string comments(const Table& table) {
  std::string text = comment(table.title) + comment(table.caption);
  for (const Column& column : table.columns) {
    if (!column.shortName.empty()) text += comment(column.shortName + ": " + heading(column));
  }
  for (const Row& row : table.rows) {
    if (!row.remark.empty()) text += comment(nameOf(table, row) + ": " + row.remark);
  }
  for (const std::string& note : table.notes) text += comment(note);
  return text;
}

}  // namespace

bool fitsTabular(const Table& table, const TabularRoom& room) {
  return layoutOf(table, room).width() <= room.width / room.fontSize;
}

std::string latexTabular(const Table& table, const TabularRoom& room) {
  const Layout layout = layoutOf(table, room);
  std::string rows;
  bool isApart = false;
  for (const Row& row : table.rows) {
    if (row.isApart && !isApart && !rows.empty()) rows += "  \\midrule\n";
    isApart = row.isApart;
    rows += bodyRow(table, layout, row);
  }
  return fmt::format(
      "{}% \\usepackage{{booktabs}}; {:.0f} mm wide in a font of {:g} points or smaller\n"
      "\\begin{{tabular}}{{{}}}\n  \\toprule\n{}  \\midrule\n{}  \\bottomrule\n\\end{{tabular}}%\n",
      comments(table), room.width / pointsOfMillimetre, room.fontSize,
      columnSpecs(table, room, layout), headRows(table, layout), rows);
}

}  // namespace gnomon::report
