#include "report/page/terminal_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <vector>

#include "report/tables/budget_table.h"
#include "report/tables/case_tables.h"
#include "report/tables/cost_table.h"
#include "report/tables/formats/terminal_format.h"
#include "report/tables/ranked_table.h"
#include "report/tables/sweep_tables.h"
#include "report/text/confidence_text.h"
#include "report/text/gate_text.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"
#include "report/text/terminal_page.h"
#include "study/judge/ranking.h"

namespace gnomon::report {
namespace {

constexpr std::size_t lightsInOwnBlocks = 3;

void appendConfidence(TerminalPage& page, const study::StudyRecord& record) {
  const std::vector<std::string> views = confidenceViews(record);
  if (!views.empty()) page.blank();
  for (const std::string& view : views) {
    const Table table = confidenceTable(record, view);
    if (table.rows.empty()) continue;
    page.heading("Verdict · " + view);
    page.paragraph(verdictText(record, view), terminalIndent);
    page.paragraph(confidenceNote(record, view), terminalIndent);
    appendTable(page, table);
    page.blank();
  }
}

std::string uncertaintyText(std::optional<double> uncertainty) {
  return uncertainty ? "truth ± " + percentText(uncertainty) : "truth's uncertainty not measured";
}

/// A block of its own for each light.
void appendLightBlocks(TerminalPage& page, const study::StudyRecord& record,
                       const std::vector<study::Case>& cases) {
  for (const study::Case& which : cases) {
    page.blank();
    page.heading(fmt::format("{} · {} ({})", which.view, which.light,
                             uncertaintyText(study::uncertaintyOf(record, which))));
    appendTable(page, caseTable(record, std::array{which}));
  }
}

/// One block for all lights of a view.
void appendViewBlock(TerminalPage& page, const study::StudyRecord& record,
                     const std::vector<study::Case>& cases) {
  std::optional<double> largest;
  for (const study::Case& which : cases) {
    if (const auto u = study::uncertaintyOf(record, which))
      largest = std::max(largest.value_or(0), *u);
  }
  page.blank();
  page.heading(fmt::format("{} · {} lights ({}{})", cases.front().view, cases.size(),
                           uncertaintyText(largest), largest ? " at most" : ""));
  appendTable(page, caseTable(record, cases));
}

void appendResults(TerminalPage& page, const study::StudyRecord& record) {
  std::vector<study::Case> left = study::casesOf(record);
  if (left.empty()) return;
  page.paragraph(fmt::format(
      "Percent of {} wrong in the drawn picture, which is the shadow test and the shading "
      "together. "
      "Test: wrong by the shadow test alone. Length: how long cast shadows are, divided by the "
      "truth's; the median. Compared with the best under that light: {}.",
      study::isSoft(record) ? "the light that is" : "the samples that are", signMeaning));
  while (!left.empty()) {
    const std::string view = left.front().view;
    const auto rest = std::stable_partition(left.begin(), left.end(),
                                            [&](const study::Case& c) { return c.view == view; });
    const std::vector<study::Case> ofView(left.begin(), rest);
    left.erase(left.begin(), rest);
    if (ofView.size() > lightsInOwnBlocks) {
      appendViewBlock(page, record, ofView);
    } else {
      appendLightBlocks(page, record, ofView);
    }
  }
}

void appendBudgets(TerminalPage& page, const study::StudyRecord& record) {
  if (record.budgets.empty()) return;
  const study::BudgetRecord& first = record.budgets.front();
  page.blank();
  page.heading("Where the error comes from");
  page.paragraph(budgetNote(first, study::isSoft(record)));
  for (const study::BudgetRecord& budget : budgetsOf(record, first.light)) {
    page.blank();
    page.paragraph(budget.method + ": " + orderText(budget, study::isSoft(record)));
    appendTable(page, budgetTable(budget));
  }
}

/// What became of a record's thresholds that are not met.
/// @param study  named as the one that was judged; of a sweep, whose value is told already
std::vector<std::string> thresholdFaults(const study::StudyRecord& record,
                                         const std::string& study) {
  std::vector<std::string> faults;
  for (study::Judgement& judgement : study::byOrigin(record.judgements).thresholds) {
    judgement.gate.step = study;
    if (judgement.isFault()) faults.push_back(gateFaultText(judgement));
  }
  return faults;
}

std::size_t thresholdsOf(const study::StudyRecord& record) {
  return study::byOrigin(record.judgements).thresholds.size();
}

void appendCost(TerminalPage& page, const study::StudyRecord& record) {
  if (record.cost.empty()) return;
  page.blank();
  page.heading(record.environment.frameClock.empty()
                   ? "Cost"
                   : fmt::format("Cost, frames by {}", record.environment.frameClock));
  appendTable(page, costTable(record));
  page.paragraph(keptFrames(record));
}

/// How far tables and marches look.
void appendRadius(TerminalPage& page, const study::StudyRecord& record) {
  if (record.methods.empty()) return;
  page.blank();
  page.paragraph("Search radius " + radiusText(record.radius));
}

/// The truth's own error.
void appendTruth(TerminalPage& page, const study::StudyRecord& record) {
  const std::string text = truthErrorText(record.truth);
  if (text.empty()) return;
  page.blank();
  page.heading("The truth");
  page.paragraph(text, terminalIndent);
}

/// Where the time went: the stages that took a hundredth of a second or more.
void appendTimings(TerminalPage& page, const study::StudyRecord& record) {
  if (record.timings.empty()) return;
  double total = 0;
  std::string stages;
  for (const study::TimingRecord& timing : record.timings) {
    total += timing.seconds;
    if (timing.seconds < 0.01) continue;
    stages += fmt::format("{}{} {:.2f}", stages.empty() ? "" : ", ", timing.stage, timing.seconds);
  }
  page.blank();
  page.paragraph(fmt::format("Time {:.2f} s{}{}", total, stages.empty() ? "" : ": ", stages));
}

/// What the run did not have to compute.
void appendCache(TerminalPage& page, const study::StudyRecord& record) {
  if (!record.cache) return;
  const cache::CacheCounts& cache = *record.cache;
  page.paragraph(fmt::format(
      "Cache: {} results of earlier runs, {} computed{}", cache.hits, cache.misses,
      cache.damaged > 0 ? fmt::format(" ({} of them were damaged there)", cache.damaged) : ""));
}

}  // namespace

std::string terminalReport(const study::StudyRecord& record, bool colours) {
  TerminalPage page(colours);
  page.heading(record.heading());
  page.paragraph(record.source);
  page.notices(record.notices);
  appendConfidence(page, record);
  appendResults(page, record);
  page.claims(record.claims);
  appendBudgets(page, record);
  page.met("Thresholds", thresholdsOf(record), thresholdFaults(record, record.name));
  appendCost(page, record);
  appendRadius(page, record);
  appendTruth(page, record);
  appendTimings(page, record);
  appendCache(page, record);
  return page.text();
}

std::string terminalReport(const study::SweepRecord& sweep, bool colours) {
  TerminalPage page(colours);
  page.heading(sweep.heading());
  page.paragraph(sweep.source);
  page.notices(sweep.notices());
  page.paragraph(fmt::format(
      "Error rate in percent, mean over lights and views, {}",
      sweep.keys.size() == 1
          ? "by " + sweep.keys.front().axis
          : fmt::format("over {} cases of {}", sweep.cases.size(), study::keysText(sweep.keys))));
  page.blank();
  constexpr std::size_t mostColumns = 50;
  constexpr std::size_t mostRows = 24;
  appendTable(page, readableSweepTable(sweep, mostColumns, mostRows));
  page.paragraph(fewerCasesNote(std::array{study::studyMeans(sweep)}), terminalIndent);
  page.claims(sweep.claims);
  std::size_t thresholds = 0;
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    thresholds += thresholdsOf(sweep.steps[i]);
    for (const std::string& fault : thresholdFaults(sweep.steps[i], sweep.name)) {
      faults.push_back(
          fmt::format("{}: {}", study::caseText(sweep.keys, sweep.cases.at(i)), fault));
    }
  }
  page.met("Thresholds", thresholds, faults);
  return page.text();
}

std::string terminalReport(std::span<const study::StudyMeans> studies, bool colours) {
  TerminalPage page(colours);
  page.heading(fmt::format("Methods over {} studies", studies.size()));
  page.paragraph(
      fmt::format("Error rate in percent, each study with the same weight. Compared with the best: "
                  "{}.",
                  signMeaning));
  appendTable(page, rankedOverStudiesTable(studies, study::rankOverStudies(studies)));
  return page.text();
}

}  // namespace gnomon::report
