#include "report/page/html_page.h"

#include <fmt/core.h>

#include "image/web_picture.h"
#include "report/page/html_figures.h"
#include "report/page/page.h"
#include "report/text/html_text.h"
#include "report/text/names.h"
#include "report/text/radius_text.h"

namespace gnomon {
namespace {

std::string tagClass(Verdict verdict) {
  return verdict == Verdict::held ? "held" : verdict == Verdict::failed ? "failed" : "open";
}

}  // namespace

std::string htmlHead(std::string_view title, std::string_view script) {
  const std::string runs = script.empty() ? "" : fmt::format("; script-src {}", script);
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'{}\">\n"
      "<title>{} – Gnomon</title>\n<style>\n{}{}</style>\n</head>\n",
      runs, escapeHtml(title), differenceProperties(), pageStyle());
}

std::string htmlSection(std::string_view id, std::string_view title, const std::string& content) {
  if (content.empty()) return "";
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, title, content);
}

std::string htmlPlot(const std::string& svg, std::string_view alt) {
  return fmt::format("<figure class=\"plot\"><img alt=\"{}\" src=\"{}\"></figure>\n",
                     escapeHtml(alt), dataAddress("image/svg+xml", svg));
}

std::string htmlFact(std::string_view term, std::string_view text) {
  if (text.empty()) return "";
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", term, escapeHtml(text));
}

std::string plural(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string htmlClaim(const ClaimRecord& claim, std::string_view study) {
  const std::string radius = radiusNote(claim);
  return fmt::format(
      "<li><span class=\"tag {}\">{}</span><div><p>{}{}</p>{}<p class=\"note\">{}</p>"
      "<p class=\"note\">{}</p></div></li>\n",
      tagClass(claim.verdict), verdictName(claim.verdict),
      study.empty() ? "" : fmt::format("<b>{}</b> ", study), escapeHtml(claim.text),
      radius.empty() ? "" : fmt::format("<p><b>{}</b></p>", escapeHtml(radius)),
      escapeHtml(claim.detail), escapeHtml(claim.source));
}

std::string htmlNotices(const std::vector<std::string>& notices) {
  std::string html;
  for (const std::string& notice : notices) {
    html += fmt::format("<p class=\"lead\"><b>Notice:</b> {}</p>\n", escapeHtml(notice));
  }
  return html;
}

std::string htmlClaims(const std::vector<ClaimRecord>& claims) {
  std::string items;
  for (const ClaimRecord& claim : claims) items += htmlClaim(claim);
  if (items.empty()) return "";
  return htmlSection("claims", "What was claimed", "<ul class=\"claims\">\n" + items + "</ul>\n");
}

}  // namespace gnomon
