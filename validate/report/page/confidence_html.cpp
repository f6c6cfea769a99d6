#include "report/page/confidence_html.h"

#include <fmt/core.h>

#include "report/page/html_page.h"
#include "report/tables/html_cells.h"
#include "report/text/budget_text.h"
#include "report/text/confidence_text.h"
#include "report/text/html_text.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "study/judge/distinguish.h"

namespace gnomon {
namespace {

std::string intervalCell(const std::optional<Interval>& interval, const std::string& reason) {
  return numberCell(escapeHtml(intervalText(interval)), reason);
}

std::string tableRow(const StudyRecord& record, const ConfidenceRecord& row,
                     const std::string& best) {
  const auto worse = differenceOf(record, row.view, row.light, row.method, best);
  std::string html =
      fmt::format("<tr><td class=\"method\">{}{}</td>{}{}", escapeHtml(row.method),
                  worse ? differenceMark(*worse) : "", numberCell(rateText(row.rate)),
                  intervalCell(row.interval, row.reason));
  html += worse ? numberCell(escapeHtml(signedPercent(worse->difference))) +
                      intervalCell(worse->interval, worse->reason)
                : numberCell("") + numberCell("");
  return html + "</tr>\n";
}

std::string viewPart(const StudyRecord& record, const std::string& view) {
  const std::vector<ConfidenceRecord> ranked = rankedIn(record, view);
  if (ranked.empty()) return "";
  std::string rows;
  for (const ConfidenceRecord& row : ranked) {
    rows += tableRow(record, row, ranked.front().method);
  }
  return fmt::format("<h3>{}</h3>\n<p><b>{}</b></p>\n<p class=\"note\">{}</p>\n", escapeHtml(view),
                     escapeHtml(verdictText(record, view)),
                     escapeHtml(confidenceNote(record, view))) +
         htmlTable("confidence", headCells({"Method"}, {"Error", "95 %", "To the best", "95 %"}),
                   rows);
}

}  // namespace

std::string confidenceSection(const StudyRecord& record) {
  std::string html;
  for (const std::string& view : confidenceViews(record)) html += viewPart(record, view);
  return html.empty() ? "" : htmlSection("confidence", "How sure the error rates are", html);
}

}  // namespace gnomon
