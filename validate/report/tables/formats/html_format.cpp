#include "report/tables/formats/html_format.h"

#include <algorithm>

#include "report/text/glossary.h"
#include "report/text/number_text.h"

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
  // A column of ranks or signs explains itself to the eye alone.
  const Html name = column.name.empty() ? html("<span class=\"unseen\">{}</span>", column.key)
                    : column.link.empty()
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
  if (cell.bar) {
    content = html("<div class=\"bar\"><span>{}</span>{}</div>", content, htmlErrorBar(*cell.bar));
  }
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
      "<div class=\"scroll\" tabindex=\"0\"><table "
      "class=\"{}\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody>\n"
      "</table></div>\n{}",
      table.kind, head, body, notes);
}

Html htmlErrorBar(const ErrorBar& bar) {
  if (!(bar.scale > 0)) return {};
  // The drawing is stretched over its cell.
  constexpr double width = 1000;
  const auto place = [&](double error) {
    return width * std::clamp(requireFinite(error, "error_rate") / bar.scale, 0.0, 1.0);
  };
  Html content;
  const auto rectangle = [&](HtmlLiteral kind, double from, double to, int top, int bottom) {
    if (!(to > from)) return;
    content += html("<rect class=\"{}\" x=\"{:.2f}\" y=\"{}\" width=\"{:.2f}\" height=\"{}\"/>",
                    htmlLiteral(kind), place(from), top, place(to) - place(from), bottom - top);
  };
  const auto line = [&](double x1, double x2, int top, int bottom) {
    content += html("<line x1=\"{:.2f}\" x2=\"{:.2f}\" y1=\"{}\" y2=\"{}\"/>", place(x1), place(x2),
                    top, bottom);
  };
  rectangle("back", 0, bar.scale, 4, 12);
  rectangle("shadow", 0, bar.falseShadow, 4, 12);
  rectangle("light", bar.falseShadow, bar.falseShadow + bar.falseLight, 4, 12);
  if (bar.uncertainty) {
    rectangle("truth", bar.error - *bar.uncertainty, bar.error + *bar.uncertainty, 1, 15);
  }
  if (bar.interval) {
    const auto [low, high] = *bar.interval;
    line(low, high, 8, 8);
    line(low, low, 4, 12);
    line(high, high, 4, 12);
  }
  return html(
      "<svg class=\"error\" viewBox=\"0 0 {} 16\" preserveAspectRatio=\"none\" "
      "aria-hidden=\"true\">{}</svg>",
      width, content);
}

}  // namespace gnomon::report
