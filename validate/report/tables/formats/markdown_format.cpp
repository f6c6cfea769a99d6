#include "report/tables/formats/markdown_format.h"

#include "common/text/one_line.h"

namespace gnomon::report {
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

}  // namespace gnomon::report
