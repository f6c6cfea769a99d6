#include "report/tables/terminal_confidence.h"

#include <fmt/core.h>

#include <string>

#include "report/text/budget_text.h"
#include "report/text/confidence_text.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "report/text/text_width.h"
#include "study/judge/distinguish.h"

namespace gnomon {
namespace {

constexpr std::size_t rateWidth = 8;
constexpr std::size_t differenceWidth = 11;
constexpr std::size_t confidenceNameWidth =
    terminalWidth - terminalIndent - rateWidth - 2 * intervalWidth - differenceWidth - markWidth;

std::string rowText(std::string_view method, std::string_view rate, std::string_view interval,
                    std::string_view difference, std::string_view ofDifference) {
  return std::string(terminalIndent, ' ') + fitLeft(method, confidenceNameWidth) +
         fitRight(rate, rateWidth) + fitRight(interval, intervalWidth) +
         fitRight(difference, differenceWidth) + fitRight(ofDifference, intervalWidth);
}

std::string rowOf(const StudyRecord& record, const ConfidenceRecord& row, const std::string& best) {
  const std::string rate = percentText(row.rate);
  const std::string interval = intervalText(row.interval);
  const auto worse = differenceOf(record, row.view, row.light, row.method, best);
  if (row.method == best || !worse) return rowText(row.method, rate, interval, "", "");
  const std::string text = rowText(row.method, rate, interval, signedPercent(worse->difference),
                                   intervalText(worse->interval));
  return text + differenceMark(*worse);
}

}  // namespace

void appendConfidence(TerminalPage& page, const StudyRecord& record) {
  const std::vector<std::string> views = confidenceViews(record);
  if (!views.empty()) page.blank();
  for (const std::string& view : views) {
    const std::vector<ConfidenceRecord> ranked = rankedIn(record, view);
    if (ranked.empty()) continue;
    page.heading(fmt::format("Verdict · {}", view));
    page.paragraph(verdictText(record, view), terminalIndent);
    page.paragraph(confidenceNote(record, view), terminalIndent);
    page.line(rowText("method", "error", "95 %", "to best", "95 %"));
    for (const ConfidenceRecord& row : ranked) {
      page.line(rowOf(record, row, ranked.front().method));
    }
    page.blank();
  }
}

}  // namespace gnomon
