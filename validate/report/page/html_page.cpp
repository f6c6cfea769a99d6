#include "report/page/html_page.h"

#include <fmt/core.h>

#include <array>

#include "report/page/html_figures.h"
#include "report/tables/formats/html_format.h"
#include "report/text/glossary.h"
#include "report/text/number_text.h"

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
  const Html runs = script.empty() ? Html() : html("; script-src {}", viewerScriptHash());
  return html(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'{}\">\n"
      "<title>{} – Gnomon</title>\n<style>\n{}{}</style>\n</head>\n<body>\n<header>\n"
      "<p class=\"kicker\">Gnomon · how right are the shadows?</p>\n{}</header>\n<main>\n{}{}"
      "</main>\n{}</body>\n</html>\n",
      runs, title, differenceProperties(), pageStyle(), header, main, htmlGlossary(header + main),
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

Html htmlPlot(const DrawnPlot& plot) {
  return html(
      "<figure class=\"plot\"><img alt=\"{}\" width=\"{}\" height=\"{}\" src=\"{}\"></figure>\n",
      plot.sheet.about, plot.sheet.width, plot.sheet.height,
      pictureAddress("image/svg+xml", plot.svg));
}

Html htmlPlots(std::span<const DrawnPlot> plots, std::string_view section) {
  Html content;
  for (const DrawnPlot& plot : plots) {
    if (plot.sheet.section != section) continue;
    content += html("<h3>{}</h3>\n{}", plot.sheet.title, htmlPlot(plot));
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
