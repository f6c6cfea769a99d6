#include "report/tables/table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include "common/error.h"
#include "common/system/memory.h"
#include "common/text.h"
#include "report/page/html_page.h"
#include "report/tables/confidence.h"
#include "report/tables/latex_table.h"
#include "report/terminal_page.h"
#include "report/text/number_text.h"

namespace gnomon::report {

namespace {

std::string valueText(Quantity quantity, double value) {
  switch (quantity) {
    case Quantity::percent:
      return percentText(value);
    case Quantity::signedPercent:
      return signedPercent(value);
    case Quantity::correlation:
      return correlationText(value);
    case Quantity::ratio:
      return ratioText(value);
    case Quantity::times:
      return ratioText(value) + "×";
    case Quantity::count:
      return groupedText(static_cast<std::uint64_t>(requireFinite(value, "count")));
    case Quantity::bytes:
      return formatBytes(requireFinite(value, "bytes"));
    case Quantity::megabytes:
      return fmt::format("{:.2f}", requireFinite(value, "bytes") / 1e6);
    case Quantity::decimals:
      return fmt::format("{:.2f}", requireFinite(value, "value"));
    default:
      return exactText(value);
  }
}

}  // namespace

Cell textCell(std::string text, std::string about) {
  return {.text = std::move(text), .about = std::move(about)};
}

Cell valueCell(std::optional<double> value, std::string about) {
  return {.value = value, .about = std::move(about)};
}

Cell countCell(std::size_t count) {
  return {.value = static_cast<double>(count)};
}

Cell flagCell(bool flag) {
  return {.value = flag ? 1 : 0};
}

Cell intervalCell(const std::optional<compare::Interval>& interval, std::string about) {
  return {.interval = interval, .about = std::move(about)};
}

Cell metricCell(const compare::Metric& metric) {
  return {.value = metric.value, .about = std::string(metric.reason)};
}

Cell heatCell(double share, double worst, std::string about) {
  Cell cell = valueCell(share, std::move(about));
  // By the square root: beside a control that gets everything wrong, small errors still differ.
  cell.heat = worst > 0 ? std::sqrt(share / worst) : 0;
  return cell;
}

bool isText(Quantity quantity) {
  return quantity == Quantity::name || quantity == Quantity::text || quantity == Quantity::code ||
         quantity == Quantity::rank;
}

std::string cellText(Quantity quantity, const Cell& cell) {
  if (cell.text) return *cell.text;
  if (quantity == Quantity::interval) return intervalText(cell.interval);
  return cell.value ? valueText(quantity, *cell.value) : "–";
}

std::string heading(const Column& column) {
  return column.unit.empty() ? column.name : column.name + ", " + column.unit;
}

std::string nameOf(const Table& table, const Row& row) {
  for (std::size_t i = 0; i < table.columns.size() && i < row.cells.size(); ++i) {
    if (table.columns[i].quantity == Quantity::name) return row.cells[i].text.value_or("");
  }
  return "";
}

std::vector<std::size_t> columnsFor(const Table& table, Readers reader) {
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if ((table.columns[i].readers & reader) != 0) columns.push_back(i);
  }
  for (const Row& row : table.rows) {
    if (row.cells.size() == table.columns.size()) continue;
    throw InternalError(fmt::format("table {}: a row of {} cells found, {} expected", table.kind,
                                    row.cells.size(), table.columns.size()));
  }
  return columns;
}

namespace {

bool isNumber(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

/// Whether a spreadsheet would take a cell for a formula.
bool isFormula(std::string_view text) {
  constexpr std::array<std::string_view, 10> signs = {"=",  "+",  "-",  "@",  "\t",
                                                      "\r", "＝", "＋", "－", "＠"};
  const bool opens = std::any_of(signs.begin(), signs.end(),
                                 [&](std::string_view sign) { return text.starts_with(sign); });
  return opens && !isNumber(text);
}

/// One cell and the comma or the end of the line behind it.
void appendCsv(std::string& csv, std::string_view asked, bool isLast) {
  std::string text = xmlText(asked);
  if (isFormula(asked)) text.insert(text.begin(), '\'');
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    csv += text;
  } else {
    csv += '"';
    for (const char c : text) {
      if (c == '"') csv += '"';
      csv += c;
    }
    csv += '"';
  }
  csv += isLast ? '\n' : ',';
}

void appendHeads(std::vector<std::string>& heads, const Column& column) {
  if (column.quantity != Quantity::interval) {
    heads.push_back(column.key.empty() ? column.name : column.key);
    return;
  }
  const std::string prefix = column.key.empty() ? "" : column.key + "_";
  heads.push_back(prefix + "low");
  heads.push_back(prefix + "high");
}

void appendCell(std::vector<std::string>& texts, Quantity quantity, const Cell& cell) {
  if (quantity == Quantity::interval) {
    texts.push_back(exactText(lowOf(cell.interval)));
    texts.push_back(exactText(highOf(cell.interval)));
  } else {
    texts.push_back(cell.value ? exactText(cell.value) : cell.text.value_or(""));
  }
}

}  // namespace

std::string csvTable(const Table& table) {
  std::string csv;
  const auto appendLine = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) appendCsv(csv, cells[i], i + 1 == cells.size());
  };
  const std::vector<std::size_t> columns = columnsFor(table, asData);
  std::vector<std::string> texts;
  for (const std::size_t i : columns) appendHeads(texts, table.columns[i]);
  appendLine(texts);
  for (const Row& row : table.rows) {
    texts.clear();
    for (const std::size_t i : columns) appendCell(texts, table.columns[i].quantity, row.cells[i]);
    appendLine(texts);
  }
  return csv;
}

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

std::string markdownCell(const Column& column, const Row& row, const Cell& cell) {
  std::string text = escapeMarkdown(trimmed(cellText(column.quantity, cell) + cell.mark));
  if (cell.emphasis == Emphasis::strong && !text.empty()) text = "**" + text + "**";
  return column.quantity == Quantity::name ? text + escapeMarkdown(row.mark) : text;
}

/// "name: what must be read with it."
std::string remarkLine(const Table& table, const Row& row) {
  std::string name;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].quantity == Quantity::name) name = row.cells[i].text.value_or("");
  }
  return "- " + escapeMarkdown(name) + ": " + escapeMarkdown(row.remark) + ".\n";
}

}  // namespace

std::string escapeMarkdown(std::string_view text) {
  std::string markdown;
  for (const char c : oneLine(text)) {
    if (std::string_view("\\`*_{}[]()<>&|~$!").find(c) != std::string_view::npos) markdown += '\\';
    markdown += c;
    // An empty comment parts the sign from what would make it a link.
    if (c == '@' || c == '#') markdown += "<!-- -->";
  }
  return markdown;
}

std::string markdownTable(const Table& table) {
  const std::vector<std::size_t> columns = columnsFor(table, onPaper);
  std::string text;
  const std::string title = trimmed(table.title);
  if (!title.empty()) text += "**" + escapeMarkdown(title) + "**";
  if (!table.caption.empty()) text += (title.empty() ? "" : ". ") + escapeMarkdown(table.caption);
  if (!text.empty()) text += "\n\n";
  const auto appendLine = [&](const auto& textOf) {
    for (const std::size_t i : columns) text += "| " + textOf(i) + " ";
    text += "|\n";
  };
  appendLine([&](std::size_t i) { return escapeMarkdown(heading(table.columns[i])); });
  appendLine([&](std::size_t i) -> std::string {
    return isText(table.columns[i].quantity) ? "---" : "--:";
  });
  std::string remarks;
  for (const Row& row : table.rows) {
    appendLine([&](std::size_t i) { return markdownCell(table.columns[i], row, row.cells[i]); });
    if (!row.remark.empty()) remarks += remarkLine(table, row);
  }
  for (const std::string& note : table.notes) remarks += "- " + escapeMarkdown(note) + "\n";
  return remarks.empty() ? text : text + "\n" + remarks;
}

std::span<const TableFormat> tableFormats() {
  static constexpr std::array<TableFormat, 5> formats = {{
      {"txt", terminalTable, false},
      {"html", [](const Table& table) { return htmlTable(table).text(); }, false},
      {"csv", csvTable, true},
      {"tex", [](const Table& table) { return latexTabular(table); }, false},
      {"md", markdownTable, true},
  }};
  return formats;
}

}  // namespace gnomon::report
