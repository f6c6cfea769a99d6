#include "report/tables/formats/latex_format.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "common/text/one_line.h"
#include "report/text/interval_text.h"

namespace gnomon::report {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 27> signs = {{
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
    {"\"", "\\textquotedbl{}"},
    {"–", "--"},
    {"--", "-{}-{}"},
    {"’", "'"},
    {"°", "\\textdegree{}"},
    {"×", "$\\times$"},
    {"≈", "$\\approx$"},
    {"−", "$-$"},
    {"≤", "$\\leq$"},
    {"≥", "$\\geq$"},
    {"±", "$\\pm$"},
    {"κ", "$\\kappa$"},
    {"…", "\\dots{}"},
    {"\u202f", "\\,"},
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

/// Letters, digits and dashes.
std::string latexKey(const std::string& name) {
  std::string key;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    key += plain ? c : '-';
  }
  return key;
}

/// "≈" of " ≈".
std::string_view withoutSpace(std::string_view mark) {
  return mark.substr(std::min(mark.find_first_not_of(' '), mark.size()));
}

std::string latexCell(const Column& column, const Cell& cell, const Row& row) {
  const std::string text = escapeLatex(cellText(column.quantity, cell) + cell.mark);
  if (column.quantity != Quantity::name || row.mark.empty()) return text;
  return escapeLatex(withoutSpace(row.mark)) + " " + text;
}

std::string latexCaption(const Table& table) {
  std::string caption = escapeLatex(table.title);
  if (!table.caption.empty()) caption += ". " + escapeLatex(table.caption);
  for (const Row& row : table.rows) {
    if (row.remark.empty()) continue;
    const auto name = std::find_if(table.columns.begin(), table.columns.end(),
                                   [](const auto& c) { return c.quantity == Quantity::name; });
    const auto index = static_cast<std::size_t>(name - table.columns.begin());
    const std::string label = index < row.cells.size() ? row.cells[index].text.value_or("") : "";
    caption += fmt::format(" {} {}.", escapeLatex(label), escapeLatex(row.remark));
  }
  return caption;
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

std::string latexTable(const Table& table) {
  const std::vector<std::size_t> columns = columnsFor(table, onPaper);
  const auto lineOf = [&](const auto& textOf) {
    std::string line;
    for (const std::size_t i : columns) line += (line.empty() ? "    " : " & ") + textOf(i);
    return line + " \\\\\n";
  };
  std::string sides;
  for (const std::size_t i : columns) sides += isText(table.columns[i].quantity) ? 'l' : 'r';
  const std::string head =
      lineOf([&](std::size_t i) { return escapeLatex(heading(table.columns[i])); });
  std::string rows;
  bool isApart = false;
  for (const Row& row : table.rows) {
    if (row.isApart && !isApart && !rows.empty()) rows += "    \\midrule\n";
    isApart = row.isApart;
    rows += lineOf([&](std::size_t i) { return latexCell(table.columns[i], row.cells[i], row); });
  }
  return fmt::format(
      "% \\usepackage{{booktabs}}\n"
      "\\begin{{table}}\n  \\centering\n  \\caption{{{}}}\n  \\label{{tab:{}}}\n"
      "  \\begin{{tabular}}{{{}}}\n    \\toprule\n{}    \\midrule\n{}"
      "    \\bottomrule\n  \\end{{tabular}}\n\\end{{table}}\n",
      latexCaption(table), latexKey(table.label), sides, head, rows);
}

}  // namespace gnomon::report
