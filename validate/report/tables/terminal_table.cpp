#include "report/tables/terminal_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "common/system/memory.h"
#include "report/tables/cost.h"
#include "report/tables/terminal_budget.h"
#include "report/tables/terminal_confidence.h"
#include "report/text/gate_text.h"
#include "report/text/number_text.h"
#include "report/text/refinement_text.h"
#include "report/text/terminal_page.h"
#include "report/text/text_width.h"
#include "study/judge/distinguish.h"
#include "study/record/cases.h"
#include "study/record/result_metrics.h"

namespace gnomon {
namespace {

constexpr std::size_t lightWidth = 16;
constexpr std::size_t lightsInOwnBlocks = 3;

struct MetricColumn {
  std::string_view metric;
  std::string_view title;
  std::size_t width;
  std::string (*text)(std::optional<double>) = percentText;
  Answer answer = Answer::drawn;
};

constexpr std::array<MetricColumn, 7> columns = {
    {{"error_rate", "error", 7},
     {"error_rate", "test", 7, percentText, Answer::test},
     {"false_shadow", "false shadow", 14},
     {"false_light", "false light", 13},
     {"iou", "IoU", 7},
     {"ber", "BER", 7},
     {"shadow_length_ratio", "length", 8, ratioText}}};

constexpr std::size_t labelRoom() {
  std::size_t width = terminalWidth - terminalIndent - markWidth;
  for (const MetricColumn& column : columns) width -= column.width;
  return width;
}

/// How wide the two name columns of a block are; `light` is 0 where the heading names the light.
struct NameWidths {
  std::size_t light = 0;
  std::size_t method = 0;
};

std::string nameCells(const NameWidths& widths, std::string_view light, std::string_view method) {
  std::string cells(terminalIndent, ' ');
  if (widths.light > 0) cells += fitLeft(light, widths.light) + "  ";
  return cells + fitLeft(method, widths.method);
}

std::string tableHead(const NameWidths& widths) {
  std::string head = nameCells(widths, "light", "method");
  for (const MetricColumn& column : columns) head += fitRight(column.title, column.width);
  return head;
}

/// @param result  of the drawn answer
std::string tableRow(const NameWidths& widths, std::string_view light, const StudyRecord& record,
                     const ResultRecord& result, bool closeToBest) {
  std::string row = nameCells(widths, light, result.method);
  for (const MetricColumn& column : columns) {
    const ResultRecord* of =
        findResult(record, result.method, {result.view, result.light}, wholeRegion, column.answer);
    const auto value = of != nullptr ? metricOf(*of, column.metric).value : std::nullopt;
    row += fitRight(column.text(value), column.width);
  }
  return closeToBest ? row + " ≈" : row;
}

NameWidths nameWidths(const std::vector<std::string>& methods, const std::vector<Case>& cases,
                      bool withLight) {
  NameWidths widths;
  widths.method = displayWidth("method");
  for (const std::string& method : methods) {
    widths.method = std::max(widths.method, displayWidth(method));
  }
  if (withLight) {
    widths.light = displayWidth("light");
    for (const Case& which : cases) {
      widths.light = std::min(lightWidth, std::max(widths.light, displayWidth(which.light)));
    }
  }
  const std::size_t taken = withLight ? widths.light + 2 : 0;
  widths.method = std::min(widths.method, labelRoom() - taken);
  return widths;
}

/// One case's rows, and which method's error is the smallest.
struct CaseRows {
  std::vector<const ResultRecord*> rows;
  const ResultRecord* best = nullptr;
};

std::optional<double> errorOf(const ResultRecord& result) {
  return metricOf(result, "error_rate").value;
}

bool isBetter(const ResultRecord& a, const ResultRecord& b) {
  return errorOf(a) && (!errorOf(b) || *errorOf(a) < *errorOf(b));
}

CaseRows rowsOf(const StudyRecord& record, const std::vector<std::string>& methods,
                const Case& which) {
  CaseRows found;
  for (const std::string& method : methods) {
    const ResultRecord* row = findResult(record, method, which);
    if (row == nullptr) continue;
    found.rows.push_back(row);
    if (found.best == nullptr || isBetter(*row, *found.best)) found.best = row;
  }
  return found;
}

void appendCase(TerminalPage& page, const StudyRecord& record,
                const std::vector<std::string>& methods, const Case& which,
                const NameWidths& widths) {
  const CaseRows found = rowsOf(record, methods, which);
  std::string_view light = which.light;
  for (const ResultRecord* row : found.rows) {
    const auto difference =
        differenceOf(record, which.view, which.light, row->method, found.best->method);
    const bool close = difference && difference->verdict == DifferenceVerdict::notDistinguishable;
    page.line(tableRow(widths, light, record, *row, close));
    if (widths.light > 0) light = "";
  }
}

std::string uncertaintyText(std::optional<double> uncertainty) {
  return uncertainty ? "truth ± " + percentText(uncertainty) : "truth's uncertainty not measured";
}

/// A block of its own for each light.
void appendLightBlocks(TerminalPage& page, const StudyRecord& record,
                       const std::vector<Case>& cases) {
  const std::vector<std::string> methods = methodsOf(record);
  const NameWidths widths = nameWidths(methods, cases, false);
  for (const Case& which : cases) {
    page.blank();
    page.heading(fmt::format("{} · {} ({})", which.view, which.light,
                             uncertaintyText(uncertaintyOf(record, which))));
    page.line(tableHead(widths));
    appendCase(page, record, methods, which, widths);
  }
}

/// One block for all lights of a view.
void appendViewBlock(TerminalPage& page, const StudyRecord& record,
                     const std::vector<Case>& cases) {
  std::optional<double> largest;
  for (const Case& which : cases) {
    if (const auto u = uncertaintyOf(record, which)) largest = std::max(largest.value_or(0), *u);
  }
  const std::vector<std::string> methods = methodsOf(record);
  const NameWidths widths = nameWidths(methods, cases, true);
  page.blank();
  page.heading(fmt::format("{} · {} lights ({}{})", cases.front().view, cases.size(),
                           uncertaintyText(largest), largest ? " at most" : ""));
  page.line(tableHead(widths));
  for (const Case& which : cases) appendCase(page, record, methods, which, widths);
}

void appendResults(TerminalPage& page, const StudyRecord& record) {
  std::vector<Case> left = casesOf(record);
  if (left.empty()) return;
  page.paragraph(
      "Rates in percent of the samples, of the drawn picture: shadow test and shading. test: the "
      "error of the shadow test alone. length: of the cast shadows over the truth's, the median. "
      "≈ not distinguishable from the best of its light.");
  while (!left.empty()) {
    const std::string view = left.front().view;
    const auto rest = std::stable_partition(left.begin(), left.end(),
                                            [&](const Case& c) { return c.view == view; });
    const std::vector<Case> ofView(left.begin(), rest);
    left.erase(left.begin(), rest);
    if (ofView.size() > lightsInOwnBlocks) {
      appendViewBlock(page, record, ofView);
    } else {
      appendLightBlocks(page, record, ofView);
    }
  }
}

void appendThresholds(TerminalPage& page, const StudyRecord& record) {
  std::size_t all = 0;
  std::vector<std::string> failed;
  for (const Judgement& judgement : withOrigin<Threshold>(record.judgements)) {
    ++all;
    if (judgement.isFault()) failed.push_back(gateFaultText(judgement));
  }
  page.met("Thresholds", all, failed);
}

constexpr std::array<std::size_t, 5> costWidths = {13, 12, 8, 10, 16};

std::string costRow(std::size_t labelWidth, std::string_view method,
                    const std::array<std::string, 5>& cells) {
  std::string row = std::string(terminalIndent, ' ') + fitLeft(method, labelWidth);
  for (std::size_t i = 0; i < cells.size(); ++i) row += fitRight(cells[i], costWidths[i]);
  return row;
}

void appendCost(TerminalPage& page, const StudyRecord& record) {
  if (record.cost.empty()) return;
  std::size_t width = displayWidth("method");
  for (const CostRecord& cost : record.cost) width = std::max(width, displayWidth(cost.method));
  const std::size_t numbers = std::accumulate(costWidths.begin(), costWidths.end(), terminalIndent);
  width = std::min(width, terminalWidth - numbers);
  page.blank();
  page.heading(record.environment.frameClock.empty()
                   ? "Cost"
                   : fmt::format("Cost, frames by {}", record.environment.frameClock));
  page.line(
      costRow(width, "method", {"triangles", "tables", "passes", "ms/frame", "to max-forsyth"}));
  for (const CostRecord& cost : record.cost) {
    page.line(costRow(
        width, cost.method,
        {groupedText(cost.polygons), formatBytes(static_cast<double>(cost.tableBytes)),
         fmt::format("{}", cost.passes), frameText(cost), timesText(frameRatio(record, cost))}));
  }
  const std::string kept = keptFrames(record);
  if (!kept.empty()) page.paragraph(kept);
}

/// How far tables and marches look.
void appendRadius(TerminalPage& page, const StudyRecord& record) {
  if (record.methods.empty()) return;
  page.blank();
  page.paragraph("Search radius " + radiusText(record.radius));
}

/// How the truth's resolution was found, where the study asks for an uncertainty.
void appendRefinement(TerminalPage& page, const StudyRecord& record) {
  const std::string text = refinementText(record.truth);
  if (text.empty()) return;
  page.blank();
  page.heading("The truth");
  page.paragraph(text, terminalIndent);
}

/// Where the time went: the stages that took a hundredth of a second or more.
void appendTimings(TerminalPage& page, const StudyRecord& record) {
  if (record.timings.empty()) return;
  double total = 0;
  std::string stages;
  for (const TimingRecord& timing : record.timings) {
    total += timing.seconds;
    if (timing.seconds < 0.01) continue;
    stages += fmt::format("{}{} {:.2f}", stages.empty() ? "" : ", ", timing.stage, timing.seconds);
  }
  page.blank();
  page.paragraph(fmt::format("Time {:.2f} s{}{}", total, stages.empty() ? "" : ": ", stages));
}

/// What the run did not have to compute.
void appendCache(TerminalPage& page, const StudyRecord& record) {
  if (!record.cache) return;
  const CacheCounts& cache = *record.cache;
  page.paragraph(fmt::format(
      "Cache: {} results of earlier runs, {} computed{}", cache.hits, cache.misses,
      cache.damaged > 0 ? fmt::format(" ({} of them were damaged there)", cache.damaged) : ""));
}

}  // namespace

std::string resultTable(const StudyRecord& record, bool colours) {
  TerminalPage page(colours);
  page.heading(record.title.empty() ? record.name : record.title);
  page.paragraph(record.source);
  page.notices(record.notices);
  appendConfidence(page, record);
  appendResults(page, record);
  page.claims(record.claims);
  appendBudgets(page, record);
  appendThresholds(page, record);
  appendCost(page, record);
  appendRadius(page, record);
  appendRefinement(page, record);
  appendTimings(page, record);
  appendCache(page, record);
  return page.text();
}

}  // namespace gnomon
