#include "report/page/html_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "report/page/picture_html.h"
#include "report/text/html.h"
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

Html cellContent(const Column& column, const Cell& cell) {
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
  Html content = cellContent(column, cell);
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

namespace {

Html verdictTag(study::Verdict verdict) {
  const char* kind = verdict == study::Verdict::held     ? "held"
                     : verdict == study::Verdict::failed ? "failed"
                                                         : "open";
  return html("<span class=\"tag {}\">{}</span>", kind, study::verdictName(verdict));
}

}  // namespace

namespace {

Html sectionHtml(const PageSection& section) {
  if (section.isFolded) {
    return html("<section id=\"{}\">\n{}</section>\n", section.id,
                htmlFold(html("<h2>{}</h2>", section.title), section.content));
  }
  return html("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", section.id, section.title,
              section.content);
}

Html contentsHtml(const std::vector<PageSection>& sections) {
  Html links;
  for (const PageSection& section : sections) {
    if (section.content.empty()) continue;
    links += html("<li><a href=\"#{}\">{}</a>{}</li>\n", section.id, section.title,
                  section.hint.empty() ? Html() : html(" <small>{}</small>", section.hint));
  }
  return html("<nav class=\"contents\" aria-label=\"Contents\">\n<ul>\n{}</ul>\n</nav>\n", links);
}

}  // namespace

Html htmlPage(std::string_view title, const Html& header,
              const std::vector<PageSection>& sections) {
  std::vector<PageSection> all = sections;
  Html main;
  for (const PageSection& section : all) {
    if (!section.content.empty()) main += sectionHtml(section);
  }
  const PageSection terms{"terms", "What the words mean", htmlGlossary(header + main)};
  if (!terms.content.empty()) main += sectionHtml(terms);
  all.push_back(terms);
  return html(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'; script-src {}\">\n"
      "<title>{} – Gnomon</title>\n<style>\n{}{}</style>\n</head>\n<body>\n<header>\n"
      "<p class=\"kicker\">Gnomon · how right are the shadows?</p>\n{}</header>\n{}<main>\n{}"
      "</main>\n<script>{}</script>\n</body>\n</html>\n",
      pageScriptHash(), title, differenceProperties(), pageStyle(), header, contentsHtml(all), main,
      pageScript());
}

Html htmlFold(const Html& summary, const Html& content, bool isOpen) {
  if (content.empty()) return {};
  return html("<details{}><summary>{}</summary>\n{}</details>\n", isOpen ? html(" open") : Html(),
              summary, content);
}

Html htmlFold(std::string_view summary, const Html& content, bool isOpen) {
  return htmlFold(escapeHtml(summary), content, isOpen);
}

Html htmlNote(std::string_view text) {
  return text.empty() ? Html() : html("<p class=\"note\">{}</p>\n", text);
}

Html htmlPlots(std::span<const DrawnPlot> plots, std::string_view section) {
  std::vector<const DrawnPlot*> own;
  for (const DrawnPlot& plot : plots) {
    if (plot.sheet.section == section) own.push_back(&plot);
  }
  Html content;
  for (const DrawnPlot* plot : own) {
    const PlotSheet& sheet = plot->sheet;
    const Html image = html("<img alt=\"{}\" width=\"{}\" height=\"{}\" src=\"{}\">", sheet.about,
                            sheet.width, sheet.height, pictureAddress("image/svg+xml", plot->svg));
    if (own.size() == 1) {
      return html("<figure class=\"plot\" tabindex=\"0\">{}<figcaption>{}</figcaption></figure>\n",
                  image, sheet.title);
    }
    content += htmlFold(html("<h3>{}</h3>", sheet.title),
                        html("<figure class=\"plot\" tabindex=\"0\">{}</figure>\n", image),
                        content.empty());
  }
  return content;
}

Html htmlFact(std::string_view term, std::string_view text) {
  return text.empty() ? Html() : html("<dt>{}</dt><dd>{}</dd>\n", term, text);
}

std::string plural(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

Html htmlStatus(study::RunStatus status) {
  const char* kind = status == study::RunStatus::pass   ? "held"
                     : status == study::RunStatus::fail ? "failed"
                                                        : "open";
  return html("<span class=\"tag {}\">{}</span>", kind, runStatusName(status));
}

Html htmlClaim(const study::ClaimRecord& claim, const Html& study) {
  const Html text = html("{}{}", study.empty() ? Html() : html("<b>{}</b> ", study), claim.text);
  const Html basis = html("{}{}", htmlNote(claim.detail), htmlNote(claim.source));
  return html(
      "<li>{}<div>{}</div></li>\n", verdictTag(claim.verdict),
      basis.empty() ? text : htmlFold(text, basis, claim.verdict == study::Verdict::failed));
}

PageSection claimSection(std::span<const study::ClaimRecord> claims) {
  Html lines;
  std::vector<std::pair<std::string, std::size_t>> counts;
  for (const study::ClaimRecord& claim : claims) {
    lines += htmlClaim(claim);
    const std::string verdict(study::verdictName(claim.verdict));
    const auto found = std::find_if(counts.begin(), counts.end(),
                                    [&](const auto& count) { return count.first == verdict; });
    if (found == counts.end()) {
      counts.emplace_back(verdict, 1);
    } else {
      ++found->second;
    }
  }
  std::string hint;
  for (const auto& [verdict, count] : counts) {
    hint += fmt::format("{}{} {}", hint.empty() ? "" : ", ", count, verdict);
  }
  return claimSection(lines, escapeHtml(hint));
}

PageSection claimSection(const Html& claims, const Html& hint) {
  return {"claims", "What was claimed",
          claims.empty() ? Html() : html("<ul class=\"claims\">\n{}</ul>\n", claims), hint};
}

Html htmlNotices(const std::vector<std::string>& notices) {
  constexpr std::size_t mostOpen = 2;
  Html open;
  Html folded;
  for (std::size_t i = 0; i < notices.size(); ++i) {
    (i < mostOpen ? open : folded) += html("<p><b>Notice:</b> {}</p>\n", notices[i]);
  }
  const std::size_t rest = notices.size() - std::min(mostOpen, notices.size());
  return open + htmlFold(plural(rest, "more notice"), folded);
}

PageSection reproduceSection(std::string_view command, const Html& facts) {
  return {"reproduce", "Run it again",
          html("<pre tabindex=\"0\"><code>{}</code></pre>\n{}", command, facts)};
}

}  // namespace gnomon::report
