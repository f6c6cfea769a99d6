#include "report/page/html_page.h"

#include <fmt/core.h>

#include <array>

#include "report/page/html_figures.h"
#include "report/page/page.h"
#include "report/plots/page_svg.h"
#include "report/tables/formats/html_format.h"
#include "report/text/names.h"
#include "report/text/terms_html.h"

namespace gnomon::report {
namespace {

Html verdictTag(study::Verdict verdict) {
  const char* kind = verdict == study::Verdict::held     ? "held"
                     : verdict == study::Verdict::failed ? "failed"
                                                         : "open";
  return html("<span class=\"tag {}\">{}</span>", kind, study::verdictName(verdict));
}

}  // namespace

Html htmlPage(std::string_view title, const Html& header, const Html& main, const Html& script) {
  const bool hasPlots = main.text().find("<figure class=\"plot") != std::string::npos;
  Html runs;
  if (hasPlots || !script.empty()) {
    runs = html("; script-src{}{}", hasPlots ? html(" {}", plotScriptHash()) : Html(),
                script.empty() ? Html() : html(" {}", viewerScriptHash()));
  }
  return html(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'{}\">\n"
      "<title>{} – Gnomon</title>\n<style>\n{}{}{}</style>\n</head>\n<body>\n<header>\n"
      "<p class=\"kicker\">Gnomon · how right are the shadows?</p>\n{}</header>\n<main>\n{}{}"
      "</main>\n{}{}</body>\n</html>\n",
      runs, title, differenceProperties(), plotProperties(), pageStyle(), header, main,
      htmlGlossary(header + main), hasPlots ? html("<script>{}</script>\n", plotScript()) : Html(),
      script.empty() ? Html() : html("<script>{}</script>\n", script));
}

Html htmlSection(std::string_view id, const Html& title, const Html& content) {
  if (content.empty()) return {};
  return html("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, title, content);
}

Html htmlSection(std::string_view id, std::string_view title, const Html& content) {
  return htmlSection(id, escapeHtml(title), content);
}

Html htmlNote(std::string_view text) {
  return text.empty() ? Html() : html("<p class=\"note\">{}</p>\n", text);
}

namespace {

/// A line and a symbol as the plot draws them, and what they stand for.
Html legendItem(const LegendItem& item) {
  Html marks;
  if (item.dash > 0) {
    // gnuplot's dashes 1 to 5.
    constexpr std::array dashes = {"", "5 3", "1.5 3", "5 3 1.5 3", "5 3 1.5 3 1.5 3"};
    marks += html(
        "<path stroke=\"currentColor\" stroke-width=\"2\" stroke-dasharray=\"{}\" "
        "d=\"M0,6 H30\"/>",
        dashes.at(static_cast<std::size_t>(item.dash - 1) % dashes.size()));
  }
  if (item.point > 0) {
    marks +=
        html("<use href=\"#gpPt{}\" transform=\"translate(15,6) scale(3.8)\"/>", item.point - 1);
  }
  if (marks.empty()) {
    marks = html("<rect fill=\"currentColor\" x=\"0\" y=\"0\" width=\"30\" height=\"12\"/>");
  }
  const Html symbol = html(
      "<svg class=\"key\" viewBox=\"0 0 30 12\" fill=\"none\" aria-hidden=\"true\" "
      "style=\"color:var(--plot-{})\">{}</svg>",
      item.variable, marks);
  if (!item.isMethod) return html("<li>{}{}</li>", symbol, item.text);
  return html(
      "<li><button type=\"button\" data-method=\"{}\" aria-pressed=\"{}\">{}{}</button></li>",
      item.variable, item.isHighlighted ? "true" : "false", symbol, item.text);
}

Html legendOf(const PlotSheet& sheet) {
  Html items;
  for (const LegendItem& item : sheet.legend) items += legendItem(item);
  return items.empty() ? Html() : html("<ul class=\"keys\">{}</ul>\n", items);
}

/// The families that a button brings back: as the plot itself has them.
Html familiesOf(const PlotSheet& sheet) {
  std::string text;
  for (const PlotColour& colour : sheet.colours) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ",", colour.variable, colour.family);
  }
  return text.empty() ? Html() : html(" data-families=\"{}\"", text);
}

}  // namespace

Html htmlPlot(const DrawnPlot& plot) {
  const bool hasNarrow = !plot.narrowSvg.empty();
  const Html wide = html("<div class=\"wide{}\"><div class=\"fit\">{}</div></div>\n",
                         hasNarrow ? "" : " scroll", pageSvg(plot.svg, plot.sheet));
  const Html narrow = hasNarrow ? html("<div class=\"narrow\"><div class=\"fit\">{}</div></div>\n",
                                       pageSvg(plot.narrowSvg, plot.narrow))
                                : Html();
  const Html values = plot.sheet.table.rows.empty()
                          ? Html()
                          : html(
                                "<details class=\"values\"><summary>The values as a "
                                "table</summary>\n{}</details>\n",
                                htmlTable(plot.sheet.table));
  return html("<figure class=\"plot{}{}\" style=\"{}\"{}>\n{}{}{}{}</figure>\n",
              hasNarrow ? " two" : "", plot.sheet.isShaded ? " shaded" : "",
              methodProperties(plot.sheet), familiesOf(plot.sheet), wide, narrow,
              legendOf(plot.sheet), values);
}

Html htmlSymbols(std::span<const DrawnPlot> plots) {
  return plots.empty() ? Html() : plotSymbols(plots.front().svg);
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
  return html("<li>{}<div><p>{}{}</p><p class=\"note\">{}</p><p class=\"note\">{}</p></div></li>\n",
              verdictTag(claim.verdict), study.empty() ? Html() : html("<b>{}</b> ", study),
              claim.text, claim.detail, claim.source);
}

Html htmlClaims(const Html& claims) {
  if (claims.empty()) return {};
  return htmlSection("claims", "What was claimed",
                     html("<ul class=\"claims\">\n{}</ul>\n", claims));
}

Html htmlNotices(const std::vector<std::string>& notices) {
  Html paragraphs;
  for (const std::string& notice : notices) {
    paragraphs += html("<p class=\"lead\"><b>Notice:</b> {}</p>\n", notice);
  }
  return paragraphs;
}

Html htmlReproduction(std::string_view command, const Html& facts) {
  return htmlSection("reproduce", "Run it again",
                     html("<pre><code>{}</code></pre>\n{}", command, facts));
}

}  // namespace gnomon::report
