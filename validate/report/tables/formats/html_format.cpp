#include "report/tables/formats/html_format.h"

#include "report/tables/formats/error_bar.h"
#include "report/text/number_text.h"
#include "report/text/terms_html.h"

namespace gnomon::report {
namespace {

Html tooltip(const std::string& about) {
  return about.empty() ? Html() : html(" title=\"{}\"", about);
}

/// The name leads to its meaning, where the glossary has it.
Html headingHtml(const Column& column) {
  const Html name = htmlHeading(column.name);
  return column.unit.empty() ? name : html("{}, {}", name, column.unit);
}

Html headCell(const Column& column) {
  const Html name = column.link.empty()
                        ? headingHtml(column)
                        : html("<a href=\"{}\">{}</a>", column.link, heading(column));
  const Html note = column.note.empty() ? Html() : html("<small>{}</small>", column.note);
  return html("<th{}{}>{}{}</th>", isText(column.quantity) ? Html() : html(" class=\"n\""),
              tooltip(column.about), name, note);
}

Html emphasised(const Html& content, Emphasis emphasis) {
  switch (emphasis) {
    case Emphasis::strong:
      return html("<b>{}</b>", content);
    case Emphasis::quiet:
      return html("<span class=\"quiet\">{}</span>", content);
    case Emphasis::good:
      return html("<span class=\"tag held\">{}</span>", content);
    case Emphasis::bad:
      return html("<span class=\"tag failed\">{}</span>", content);
    case Emphasis::open:
      return html("<span class=\"tag open\">{}</span>", content);
    default:
      return content;
  }
}

Html smallNote(const std::string& text) {
  return text.empty() ? Html() : html("<small class=\"same\">{}</small>", text);
}

Html contentOf(const Column& column, const Cell& cell) {
  Html content = escapeHtml(cellText(column.quantity, cell) + cell.mark);
  if (!cell.link.empty()) content = html("<a href=\"{}\">{}</a>", cell.link, content);
  if (cell.uncertainty) {
    content += html(" <small>±&#8239;{}</small>", percentText(cell.uncertainty));
  }
  if (column.quantity == Quantity::code) content = html("<code>{}</code>", content);
  return emphasised(content, column.isMain ? Emphasis::strong : cell.emphasis);
}

Html classOf(const Column& column, const Cell& cell) {
  if (cell.heat) return html(" class=\"n heat\" style=\"--heat:{:.3f}\"", *cell.heat);
  if (column.quantity == Quantity::name) return html(" class=\"method\"");
  if (column.quantity == Quantity::rank) return html(" class=\"rank\"");
  return isText(column.quantity) ? Html() : html(" class=\"n\"");
}

Html bodyCell(const Column& column, const Cell& cell, const Row& row) {
  Html content = contentOf(column, cell);
  const bool isName = column.quantity == Quantity::name;
  if (isName) content += escapeHtml(row.mark);
  if (cell.bar) content += htmlErrorBar(*cell.bar);
  content += smallNote(cell.note);
  if (isName) content += smallNote(row.remark);
  return html("<td{}{}>{}</td>", classOf(column, cell), tooltip(cell.about), content);
}

}  // namespace

Html htmlTable(const Table& table) {
  const std::vector<std::size_t> columns = columnsFor(table, onPage);
  Html head;
  for (const std::size_t i : columns) head += headCell(table.columns[i]);
  Html body;
  for (const Row& row : table.rows) {
    Html cells;
    for (const std::size_t i : columns) {
      cells += bodyCell(table.columns[i], row.cells[i], row);
    }
    body += html("<tr>{}</tr>\n", cells);
  }
  Html notes;
  for (const std::string& note : table.notes) {
    notes += html("<p class=\"note\">{}</p>\n", note);
  }
  return html(
      "<div class=\"scroll\"><table "
      "class=\"{}\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody>\n"
      "</table></div>\n{}",
      table.kind, head, body, notes);
}

}  // namespace gnomon::report
