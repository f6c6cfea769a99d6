#include "report/tables/confidence.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/lists.h"
#include "report/text/number_text.h"
#include "report/text/verdict_text.h"
#include "study/judge/distinguish.h"
#include "study/judge/ranking.h"
#include "study/run/stages/budget.h"

namespace gnomon::report {

namespace {

/// What several rows say of one figure: "0.30", or "0.30 to 0.55" where they differ.
class Range {
 public:
  void add(double value) {
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  [[nodiscard]] bool isEmpty() const { return low_ > high_; }
  template <typename Text>
  [[nodiscard]] std::string text(const Text& textOf) const {
    const std::string low = textOf(low_);
    const std::string high = textOf(high_);
    return low == high ? low : low + " to " + high;
  }

 private:
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

/// @param difference  of the worse method, less the best
/// @param whole  what it is a share of (errorWhole)
std::string betterText(const study::DifferenceRecord& difference, const char* whole) {
  return fmt::format("{} is better than {} by {} % of {} (95 % interval {}).",
                     quotedText(difference.second), quotedText(difference.first),
                     percentText(difference.difference), whole, intervalText(difference.interval));
}

}  // namespace

std::vector<std::string> confidenceViews(const study::StudyRecord& record) {
  std::vector<std::string> views;
  for (const study::ConfidenceRecord& row : record.confidence) appendOnce(views, row.view);
  return views;
}

std::vector<study::ConfidenceRecord> rankedIn(const study::StudyRecord& record,
                                              const std::string& view) {
  std::vector<study::ConfidenceRecord> ranked;
  for (const study::ConfidenceRecord& row : record.confidence) {
    if (row.view == view && row.light == study::allLights) ranked.push_back(row);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.rate < b.rate; });
  return ranked;
}

std::string verdictText(const study::StudyRecord& record, const std::string& view) {
  const std::vector<study::ConfidenceRecord> ranked = rankedIn(record, view);
  if (ranked.size() < 2) return "";
  const std::string& best = ranked.front().method;
  std::string better;
  study::LikeMethods like;
  for (const study::DifferenceRecord& difference : differencesToBest(record, view)) {
    like.add(difference.first, difference.verdict);
    if (better.empty() && study::isDistinguishable(difference.verdict)) {
      better = betterText(difference, errorWhole(study::isSoft(record)));
    }
  }
  std::string text = better;
  const auto add = [&](const std::string& sentence) {
    text += (text.empty() ? "" : " ") + sentence;
  };
  const std::string name = quotedText(best);
  if (!like.equal.empty()) {
    add(fmt::format("{} gives the same answers as {}.", name, listText(like.equal)));
  }
  if (!like.close.empty()) {
    add(fmt::format("{} is not distinguishable from {}.", name, listText(like.close)));
  }
  if (!like.withoutInterval.empty()) {
    add(fmt::format("{} could not be compared with {}: the difference has no 95 % interval.", name,
                    listText(like.withoutInterval)));
  }
  return text;
}

std::vector<study::DifferenceRecord> differencesToBest(const study::StudyRecord& record,
                                                       const std::string& view) {
  const std::vector<study::ConfidenceRecord> ranked = rankedIn(record, view);
  std::vector<study::DifferenceRecord> found;
  for (const study::ConfidenceRecord& row : ranked) {
    const auto toBest =
        study::differenceOf(record, view, study::allLights, row.method, ranked.front().method);
    if (toBest) found.push_back(*toBest);
  }
  return found;
}

std::string blocksText(const study::StudyRecord& record, const std::string& view) {
  const std::vector<study::ConfidenceRecord> ranked = rankedIn(record, view);
  if (ranked.empty()) return "";
  Range blocks;
  for (const study::ConfidenceRecord& row : ranked) blocks.add(static_cast<double>(row.blocks));
  return fmt::format("The intervals come from {} blocks of {} × {} samples.",
                     blocks.text([](double count) { return fmt::format("{}", count); }),
                     ranked.front().blockSide, ranked.front().blockSide);
}

std::string confidenceNote(const study::StudyRecord& record, const std::string& view) {
  const std::string blocks = blocksText(record, view);
  if (blocks.empty()) return "";
  Range uncertainty;
  for (const study::DifferenceRecord& toBest : differencesToBest(record, view)) {
    uncertainty.add(toBest.uncertainty);
  }
  const std::string truth =
      uncertainty.isEmpty()
          ? ""
          : fmt::format(" The truth’s uncertainty is {} %.",
                        uncertainty.text([](double share) { return percentText(share); }));
  return fmt::format("Percent of {}, mean over the lights. {}{}", errorWhole(study::isSoft(record)),
                     blocks, truth);
}

std::string restName(std::string_view rest) {
  return fmt::format("left: {}", rest);
}

std::string budgetNote(const study::BudgetRecord& budget, bool isSoft) {
  return fmt::format(
      "Percent of {} of view {}, {}. A cause’s share is the error before the cause is "
      "corrected minus the error after. Causes are corrected in the order of the list (forward) or "
      "from its end (backward), each time starting from the published method. A share below zero: "
      "the correction made the error larger. {} It comes from {} blocks. ≈ not distinguishable "
      "from zero: the interval contains 0, or the share is within the truth’s uncertainty of {} %; "
      "= no answer changed; ? no interval. What is left is split by region, each sample in the "
      "first that it is "
      "in: "
      "{}.",
      errorWhole(isSoft), budget.view,
      budget.light == "all" ? "mean over all lights" : budget.light, intervalMeaning, budget.blocks,
      percentText(budget.uncertainty), fmt::join(study::budgetRestNames(), ", "));
}

std::string orderText(const study::BudgetRecord& budget, bool isSoft) {
  const double moved = study::orderDependence(budget);
  if (!(budget.total.value > 0)) return "No error to attribute.";
  return fmt::format(
      "{} % wrong. The two orders assign {} % of {}, {:.0f} % of the error, to different "
      "causes.",
      percentText(budget.total.value), percentText(moved), errorWhole(isSoft),
      100 * moved / budget.total.value);
}

std::vector<std::string> budgetLights(const study::StudyRecord& record) {
  std::vector<std::string> lights;
  for (const study::BudgetRecord& budget : record.budgets) {
    appendOnce(lights, budget.light);
  }
  return lights;
}

std::vector<study::BudgetRecord> budgetsOf(const study::StudyRecord& record,
                                           const std::string& light) {
  std::vector<study::BudgetRecord> budgets;
  for (const study::BudgetRecord& budget : record.budgets) {
    if (budget.light == light) budgets.push_back(budget);
  }
  return budgets;
}

std::string intervalEndText(std::optional<double> end) {
  if (!end) return "–";
  const double percent = 100 * requireFinite(*end, "interval");
  const double rounded = std::round(100 * percent) / 100;
  return fmt::format("{}{:.2f}", rounded < 0 ? "−" : "", std::abs(rounded));
}

std::string intervalText(const std::optional<compare::Interval>& interval) {
  return interval ? intervalEndText(interval->low) + " to " + intervalEndText(interval->high) : "–";
}

std::optional<double> lowOf(const std::optional<compare::Interval>& interval) {
  return interval ? std::optional(interval->low) : std::nullopt;
}

std::optional<double> highOf(const std::optional<compare::Interval>& interval) {
  return interval ? std::optional(interval->high) : std::nullopt;
}

std::string stepText(double texels) {
  return fmt::format("{:.4g}", requireFinite(texels, "truth.step_texels"));
}

std::string flipText(std::optional<double> rate) {
  return rate ? fmt::format("{:.3g}", 100 * requireFinite(*rate, "flip rate")) : "–";
}

std::string radiusText(const study::RadiusRecord& radius) {
  return fmt::format("{} texels: {}", stepText(radius.texels), radius.reason);
}

std::string truthErrorText(const study::TruthRecord& truth) {
  const auto largest =
      std::max_element(truth.flips.begin(), truth.flips.end(),
                       [](const auto& a, const auto& b) { return a.flipRate < b.flipRate; });
  if (largest == truth.flips.end() || !largest->brightening) return "";
  const study::UncertaintyRecord& flip = *largest;
  const double change = *flip.brightening;
  const std::string where =
      truth.flips.size() == 1
          ? ""
          : fmt::format(" under \"{}\" in \"{}\", the most", flip.light, flip.view);
  if (!flip.percentile999) {
    return fmt::format(
        "Traced at half its resolution the truth changes at {} % of the samples{}. Of all samples "
        "{} "
        "% more turn {} than the reverse.",
        flipText(flip.flipRate), where, flipText(std::abs(change)), change < 0 ? "dark" : "lit");
  }
  return fmt::format(
      "Traced at half its resolution, toward half as many directions, V changes by {:.2g} in the "
      "mean{}. A single sample may be off by far more: 99.9 % of them change by at most {:.2g}. In "
      "the mean the coarser truth is {} by {:.2g}.",
      flip.flipRate, where, *flip.percentile999, change < 0 ? "darker" : "brighter",
      std::abs(change));
}

namespace {

void appendShare(Row& row, const study::BudgetShare& share) {
  const bool isSure = study::isDistinguishable(share.verdict);
  Cell cell =
      valueCell(share.value, isSure ? "" : std::string(differenceVerdictName(share.verdict)));
  cell.emphasis = isSure ? Emphasis::strong : Emphasis::quiet;
  cell.mark = differenceSign(share.verdict);
  row.cells.push_back(std::move(cell));
  row.cells.push_back(intervalCell(share.interval, share.reason));
}

Row budgetRow(const std::string& name, const study::BudgetShare& forward,
              const study::BudgetShare& backward) {
  Row row{{textCell(name)}};
  appendShare(row, forward);
  appendShare(row, backward);
  return row;
}

Row causeRow(const study::BudgetCause& cause) {
  Row row = budgetRow(cause.name, cause.forward, cause.backward);
  if (!cause.change.empty()) row.cells.front().note = "→ " + cause.change;
  row.cells.push_back(valueCell(cause.backward.value - cause.forward.value));
  return row;
}

/// What both orders give alike.
Row restRow(const std::string& name, const study::BudgetShare& share) {
  Row row = budgetRow(name, share, share);
  row.cells.push_back(textCell(""));
  return row;
}

Row partRow(const study::BudgetRecord& budget, const std::string& part,
            const study::BudgetShare& forward, const study::BudgetShare& backward) {
  Row row{{textCell(budget.method), textCell(budget.view), textCell(budget.light), textCell(part)}};
  for (const study::BudgetShare* share : {&forward, &backward}) {
    row.cells.push_back(valueCell(share->value));
    row.cells.push_back(intervalCell(share->interval));
    row.cells.push_back(flagCell(study::isDistinguishable(share->verdict)));
  }
  row.cells.push_back(valueCell(budget.uncertainty));
  return row;
}

}  // namespace

Table budgetTable(const study::BudgetRecord& budget) {
  using Q = Quantity;
  Table table{.kind = "budget",
              .columns = {{"Cause", "cause", Q::name},
                          {"Forward", "forward", Q::signedPercent},
                          {"95 %", "forward", Q::interval},
                          {"Backward", "backward", Q::signedPercent},
                          {"95 %", "backward", Q::interval},
                          {"Difference", "difference", Q::signedPercent, byAll & ~onTerminal}}};
  table.columns[0].width = 38;
  for (const std::size_t i : {1U, 3U}) table.columns[i].markWidth = 2;
  for (const study::BudgetCause& cause : budget.causes) table.rows.push_back(causeRow(cause));
  for (const study::BudgetRest& rest : budget.rest) {
    table.rows.push_back(restRow(restName(rest.name), rest.share));
  }
  table.rows.push_back(restRow("all of the error", budget.total));
  return table;
}

Table budgetPartsTable(const study::StudyRecord& record) {
  using Q = Quantity;
  Table table{.kind = "budget",
              .columns = {{"method"},
                          {"view"},
                          {"light"},
                          {"part"},
                          {"forward", "", Q::exact},
                          {"95 %", "forward", Q::interval},
                          {"forward_distinguishable", "", Q::exact},
                          {"backward", "", Q::exact},
                          {"95 %", "backward", Q::interval},
                          {"backward_distinguishable", "", Q::exact},
                          {"uncertainty", "", Q::exact}}};
  for (const study::BudgetRecord& budget : record.budgets) {
    table.rows.push_back(partRow(budget, "total", budget.total, budget.total));
    for (const study::BudgetCause& cause : budget.causes) {
      table.rows.push_back(partRow(budget, cause.name, cause.forward, cause.backward));
    }
    for (const study::BudgetRest& rest : budget.rest) {
      table.rows.push_back(partRow(budget, rest.name, rest.share, rest.share));
    }
  }
  return table;
}

namespace {

Row confidenceRow(const study::StudyRecord& record, const study::ConfidenceRecord& row,
                  const std::string& best) {
  Row cells{{textCell(row.method), valueCell(row.rate), intervalCell(row.interval, row.reason)}};
  const auto worse = study::differenceOf(record, row.view, row.light, row.method, best);
  if (row.method == best || !worse) {
    cells.cells.push_back(textCell(""));
    cells.cells.push_back(textCell(""));
    return cells;
  }
  cells.cells.push_back(valueCell(worse->difference));
  cells.cells.push_back(intervalCell(worse->interval, worse->reason));
  cells.mark = differenceSign(worse->verdict);
  return cells;
}

}  // namespace

Table confidenceTable(const study::StudyRecord& record, const std::string& view) {
  using Q = Quantity;
  Table table{.kind = "confidence",
              .columns = {{"Method", "method", Q::name},
                          {"Error", "error_rate", Q::percent},
                          {"95 %", "", Q::interval},
                          {"To best", "to_best", Q::signedPercent},
                          {"95 %", "to_best", Q::interval}}};
  table.columns[0].width = 44;
  const std::vector<study::ConfidenceRecord> ranked = rankedIn(record, view);
  for (const study::ConfidenceRecord& row : ranked) {
    table.rows.push_back(confidenceRow(record, row, ranked.front().method));
  }
  table.notes = noIntervalNotes(differencesToBest(record, view));
  return table;
}

}  // namespace gnomon::report
