#include "report/tables/formats/csv_format.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "report/text/utf8_text.h"

namespace gnomon::report {
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

}  // namespace gnomon::report
