#include "report/terminal_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "report/tables/case_tables.h"
#include "report/tables/confidence.h"
#include "report/tables/cost_table.h"
#include "report/tables/ranked_table.h"
#include "report/tables/sweep_tables.h"
#include "report/terminal_page.h"
#include "report/text/number_text.h"
#include "report/text/verdict_text.h"
#include "study/judge/ranking.h"
#include "study/record/cases.h"

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

namespace {

constexpr std::size_t mostMethod = 24;
constexpr std::size_t verdictWidth = 11;

using Cells = std::array<std::string, 7>;
using CheckWidths = std::array<std::size_t, 7>;
enum CheckColumn : std::size_t { method, metric, place, value, limit, margin, verdict };

std::string anyOr(const std::string& name) {
  return name.empty() ? "any" : name;
}

std::string placeText(const study::Gate& gate) {
  std::string text = fmt::format("{}, {}", anyOr(gate.view), anyOr(gate.light));
  if (gate.region != study::wholeRegion) text += ", " + gate.region;
  if (gate.answer != study::Answer::drawn)
    text += fmt::format(", {}", study::answerName(gate.answer));
  const std::string value = study::stepValue(gate.step);
  return value.empty() ? text : value + ", " + text;
}

/// Four decimals; four digits where a limit is so far off that these would fill the table.
std::string marginText(double margin) {
  return std::abs(margin) < 1e4 ? fmt::format("{:+.4f}", margin) : fmt::format("{:+.3e}", margin);
}

Cells cellsOf(const study::Judgement& judgement) {
  const study::Gate& gate = judgement.gate;
  const auto margin = judgement.margin();
  return {anyOr(gate.method),
          std::string(gate.metric.name()),
          placeText(gate),
          judgement.value ? fmt::format("{:.4f}", *judgement.value) : "–",
          limitText(gate),
          margin ? marginText(*margin) : "–",
          gateVerdictName(judgement.verdict)};
}

/// Each column as wide as its widest cell; the method's, then the place's cut to what is left.
CheckWidths widthsOf(const std::vector<Cells>& rows) {
  CheckWidths widths{};
  for (const Cells& cells : rows) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      widths[i] = std::max(widths[i], displayWidth(cells[i]));
    }
  }
  widths[CheckColumn::method] = std::min(widths[CheckColumn::method], mostMethod);
  widths[CheckColumn::verdict] = verdictWidth;
  std::size_t taken = terminalIndent + 2 * (widths.size() - 1);
  for (std::size_t i = 0; i < widths.size(); ++i) taken += i == CheckColumn::place ? 0 : widths[i];
  const std::size_t room = taken < terminalWidth ? terminalWidth - taken : 1;
  widths[CheckColumn::place] = std::min(widths[CheckColumn::place], room);
  return widths;
}

std::string rowText(const Cells& cells, const CheckWidths& widths) {
  std::string row(terminalIndent, ' ');
  for (std::size_t i = 0; i < CheckColumn::verdict; ++i) {
    const bool number = i >= CheckColumn::value;
    row += (number ? fitRight(cells[i], widths[i]) : fitLeft(cells[i], widths[i])) + "  ";
  }
  return row;
}

const char* verdictColour(study::GateVerdict verdict) {
  return verdict == study::GateVerdict::passed ? "32" : "33";
}

std::size_t countOf(std::span<const study::Judgement> judgements, study::GateVerdict verdict) {
  return static_cast<std::size_t>(std::count_if(
      judgements.begin(), judgements.end(),
      [&](const study::Judgement& judgement) { return judgement.verdict == verdict; }));
}

/// Every gate that does not hold, whole, and how to reproduce it.
void appendFaults(TerminalPage& page, const study::CheckRecord& check) {
  if (const std::size_t count = check.problems.size(); count > 0) {
    const std::string errors = fmt::format("{} {}", count, count == 1 ? "error" : "errors");
    page.line(std::string(terminalIndent, ' ') + page.styled(errors, "31") +
              ", told on standard error");
  }
  for (const study::Judgement& judgement : check.judgements) {
    if (!judgement.isFault()) continue;
    const bool failed = judgement.verdict == study::GateVerdict::failed;
    page.fault(failed ? "failed" : "undefined", gateFaultText(judgement));
  }
  if (check.status() == ExitStatus::pass) return;
  page.line(std::string(terminalIndent, ' ') + "Reproduce:");
  page.line(std::string(2 * terminalIndent, ' ') + terminalText(check.command));
}

/// The thresholds that hold or are left out.
void appendTable(TerminalPage& page, std::vector<study::Judgement> judgements) {
  std::erase_if(judgements, [](const study::Judgement& judgement) { return judgement.isFault(); });
  if (judgements.empty()) return;
  std::vector<Cells> rows = {
      {"method", "metric", "view, light", "value", "limit", "margin", "verdict"}};
  for (const study::Judgement& judgement : judgements) rows.push_back(cellsOf(judgement));
  const CheckWidths widths = widthsOf(rows);
  page.line(rowText(rows.front(), widths) + rows.front()[CheckColumn::verdict]);
  for (std::size_t i = 0; i < judgements.size(); ++i) {
    const Cells& cells = rows[i + 1];
    page.line(rowText(cells, widths) +
              page.styled(cells[CheckColumn::verdict], verdictColour(judgements[i].verdict)));
  }
}

void appendReferences(TerminalPage& page, const std::string& file,
                      std::span<const study::Judgement> references) {
  if (references.empty()) return;
  const std::size_t skipped = countOf(references, study::GateVerdict::skipped);
  page.paragraph(fmt::format("{}: {} of {} references hold{}", file,
                             countOf(references, study::GateVerdict::passed), references.size(),
                             skipped > 0 ? fmt::format(", {} skipped", skipped) : ""),
                 terminalIndent);
}

}  // namespace

std::string checkTable(const study::CheckRecord& check, bool colours) {
  TerminalPage page(colours);
  page.heading(fmt::format("{} ({})", check.name, check.file));
  appendFaults(page, check);
  const auto [thresholds, references, options] = study::byOrigin(check.judgements);
  appendTable(page, thresholds);
  appendReferences(page, check.baseline, references);
  return page.text();
}

std::string checkNotices(std::span<const study::CheckRecord> checks) {
  TerminalPage page(false);
  for (const study::CheckRecord& check : checks) {
    for (const study::NoticeRecord& notice : check.notices) {
      const std::string place =
          notice.line > 0 ? fmt::format("{}:{}", check.file, notice.line) : check.file;
      page.paragraph(fmt::format("Notice: {}: {}", place, notice.text));
    }
  }
  return page.text();
}

std::string checkSummary(std::span<const study::CheckRecord> checks, ExitStatus status,
                         bool colours) {
  std::vector<study::Judgement> gates;
  std::size_t problems = 0;
  std::string bad;
  for (const study::CheckRecord& check : checks) {
    gates.insert(gates.end(), check.judgements.begin(), check.judgements.end());
    problems += check.problems.size();
    if (check.status() != ExitStatus::pass) bad += (bad.empty() ? "" : ", ") + check.name;
  }
  TerminalPage page(colours);
  page.paragraph(fmt::format(
      "Check of {} {}: {} of {} gates passed, {} failed, {} undefined, {} skipped, {} {}. Exit "
      "status {}.",
      checks.size(), checks.size() == 1 ? "study" : "studies",
      countOf(gates, study::GateVerdict::passed), gates.size(),
      countOf(gates, study::GateVerdict::failed), countOf(gates, study::GateVerdict::undefined),
      countOf(gates, study::GateVerdict::skipped), problems, problems == 1 ? "error" : "errors",
      static_cast<int>(status)));
  if (!bad.empty()) page.paragraph("Not passed: " + bad);
  return page.text();
}

}  // namespace gnomon::report
