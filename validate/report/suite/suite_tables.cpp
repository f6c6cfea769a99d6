#include "report/suite/suite_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>

#include "common/lists.h"
#include "report/text/number_text.h"
#include "report/text/verdict_text.h"
#include "study/judge/ranking.h"
#include "study/run/scene/view_samples.h"

namespace gnomon::report {
namespace {

using Q = Quantity;

Column column(std::string name, Q quantity, std::string about = "", std::string key = "",
              unsigned readers = byAll) {
  Column made{std::move(name), std::move(key), quantity, readers};
  made.about = std::move(about);
  return made;
}

/// The method of rank 1; nullptr where no method has a rank.
const study::SuiteMethod* leaderOf(const study::SuiteStatistics& statistics) {
  const bool isAny = !statistics.methods.empty() && statistics.methods.front().rank;
  return isAny ? &statistics.methods.front() : nullptr;
}

/// A method less the first of the ranking; none of that one itself, and without a rank.
std::optional<study::SuitePair> pairToFirst(const study::SuiteStatistics& statistics,
                                            const study::SuiteMethod& method) {
  const study::SuiteMethod* leader = leaderOf(statistics);
  if (leader == nullptr || leader == &method || !method.rank) return std::nullopt;
  return study::findPair(statistics, method.label, leader->label);
}

Row rankedRow(const study::SuiteStatistics& statistics, const study::SuiteMethod& method) {
  const compare::SceneSpread& spread = method.spread;
  Cell worst = textCell(method.worstScene);
  worst.link = study::reportOf(statistics, method.worstScene);
  Cell rank;
  Cell ranks;
  Cell stability;
  if (method.rank) {
    rank.value = static_cast<double>(method.rank->rank);
    ranks.text = rankText(method.rank->low, method.rank->high);
    stability.value = method.rank->stability;
  }
  const auto pair = pairToFirst(statistics, method);
  return {{rank, textCell(study::labelWithName(method.label, method.names)), valueCell(spread.mean),
           intervalCell(method.interval, method.reason), valueCell(spread.median),
           intervalCell(compare::Interval{spread.lowerQuartile, spread.upperQuartile}),
           valueCell(spread.percentile95), valueCell(spread.worstTwentieth),
           valueCell(spread.worst), worst, ranks, stability, valueCell(method.uncertainty)},
          std::string(pair ? differenceSign(pair->verdict) : ""),
          method.rank ? ""
                      : fmt::format("on {} of {} scenes: no rank", spread.scenes,
                                    statistics.table.scenes.size()),
          !method.rank};
}

/// Where a bin lies; the one without a lower end comes first.
using Ends = std::pair<std::optional<double>, std::optional<double>>;

Cell binCell(const study::SuiteBin* bin, double worst) {
  if (bin == nullptr) return valueCell({}, "no samples there");
  const compare::BinnedError& error = bin->error;
  std::string about = fmt::format("{} of the samples, on {} scenes",
                                  percentText(error.weight) + " %", error.scenes);
  if (error.interval) {
    about += fmt::format("; 95 %: {} to {}", percentText(error.interval->low),
                         percentText(error.interval->high));
  }
  return heatCell(error.errorRate, worst, std::move(about));
}

std::map<std::string, std::size_t> ranksOn(const compare::SceneTable& table, std::size_t scene) {
  std::map<std::string, std::size_t> ranks;
  for (std::size_t m = 0; m < table.methods.size(); ++m) {
    const auto own = table.errors[m][scene];
    if (!own) continue;
    ranks[table.methods[m]] =
        1 + static_cast<std::size_t>(
                std::count_if(table.errors.begin(), table.errors.end(),
                              [&](const auto& row) { return row[scene] && *row[scene] < *own; }));
  }
  return ranks;
}

}  // namespace

SuiteFigure suiteFigure(const study::SuiteStatistics& statistics) {
  const char* whole = errorWhole(statistics.isSoft);
  if (statistics.isSoft) return {"mae", "Mean |ΔV|", whole};
  return {"error_rate", "Error rate", whole};
}

std::string probabilityText(double probability) {
  return probability < 0.0005 ? "<0.001" : fmt::format("{:.3f}", probability);
}

std::string rankText(std::size_t low, std::size_t high) {
  return low == high ? fmt::format("{}", low) : fmt::format("{} to {}", low, high);
}

std::vector<std::string> suiteAxes(const study::SuiteStatistics& statistics) {
  std::vector<std::string> axes;
  for (const study::SampleAxis& axis : study::sampleAxes()) {
    const bool isAny =
        std::any_of(statistics.bins.begin(), statistics.bins.end(),
                    [&](const study::SuiteBin& bin) { return bin.axis == axis.name; });
    if (isAny) axes.emplace_back(axis.name);
  }
  return axes;
}

Table suiteRankedTable(const study::SuiteStatistics& statistics) {
  constexpr unsigned wide = byAll & ~inColumn;
  const SuiteFigure figure = suiteFigure(statistics);
  Table table{
      .kind = "suite",
      .label = statistics.suite,
      .title = fmt::format("{}: {} scenes", statistics.suite, statistics.table.scenes.size()),
      .caption = fmt::format(
          "{} in percent of {} of a scene, over the scenes; the intervals are of "
          "95\u202f% and hold for new scenes of the suite. Worst 5\u202f%: mean over "
          "the worst twentieth of the scenes. Ranks: of 95\u202f% of the resamples of "
          "the scenes. Compared with the first, by Holm's correction over all pairs: {}.",
          figure.name, figure.of, signMeaning),
      .columns = {column("", Q::rank, "", "rank", wide), column("Method", Q::name),
                  column("Mean", Q::percent),
                  column("95 %", Q::interval, "of the mean, over scenes", "interval"),
                  column("Median", Q::percent),
                  column("Quartiles", Q::interval, "half of the scenes lie between", "", wide),
                  column("95th", Q::percent, "95 of 100 scenes have no more", "percentile95"),
                  column("Worst 5 %", Q::percent, "mean over the worst twentieth of the scenes",
                         "worst_twentieth", wide),
                  column("Worst", Q::percent, "on any scene", "", wide),
                  column("Worst scene", Q::text, "", "", wide),
                  column("Ranks", Q::text, "in 95 % of the resamples of the scenes"),
                  column("Same rank", Q::percent,
                         "share of the resamples in which the rank is the same", "", wide),
                  column("Truth ±", Q::percent, "mean of the truth's uncertainty over the scenes",
                         "uncertainty", wide)},
      .apart = "Not on every scene: no rank, since means over other scenes cannot be compared."};
  table.columns[2].isMain = true;
  std::vector<study::DifferenceRecord> toFirst;
  for (const study::SuiteMethod& method : statistics.methods) {
    table.rows.push_back(rankedRow(statistics, method));
    const auto pair = pairToFirst(statistics, method);
    if (!pair) continue;
    study::DifferenceRecord& difference = toFirst.emplace_back();
    difference.first = method.label;
    difference.reason = pair->reason;
    difference.verdict = pair->verdict;
  }
  table.notes = noIntervalNotes(toFirst);
  return table;
}

Table suiteLeaderTable(const study::SuiteStatistics& statistics) {
  Table table{.kind = "suite-pairs",
              .columns = {column("Method", Q::name),
                          column("More than the first", Q::signedPercent,
                                 fmt::format("mean difference of the errors, percent of {}",
                                             suiteFigure(statistics).of)),
                          column("95 %", Q::interval, "of the difference, by itself"),
                          column("p, Holm", Q::text, "of no difference, corrected for all pairs"),
                          column("First wins", Q::percent,
                                 "probability that the first has the smaller error on a new scene"),
                          column("95 %", Q::interval, "of that probability"),
                          column("Scenes", Q::count), column("The first is", Q::text)}};
  const study::SuiteMethod* leader = leaderOf(statistics);
  if (leader == nullptr) return table;
  for (const study::SuiteMethod& method : statistics.methods) {
    if (&method == leader) continue;
    const auto pair = study::findPair(statistics, leader->label, method.label);
    if (!pair) continue;
    const auto behind = *study::findPair(statistics, method.label, leader->label);
    Cell verdict = textCell(std::string(differenceVerdictName(pair->verdict)), pair->reason);
    if (!study::isDistinguishable(pair->verdict)) verdict.emphasis = Emphasis::open;
    table.rows.push_back(
        {{textCell(method.label), valueCell(behind.difference),
          intervalCell(behind.interval, pair->reason),
          textCell(probabilityText(pair->adjusted),
                   fmt::format("{} by itself", probabilityText(pair->probability))),
          valueCell(pair->wins.probability), intervalCell(pair->wins.interval),
          countCell(pair->wins.scenes), verdict}});
  }
  return table;
}

Table suiteScenesTable(const study::SuiteStatistics& statistics, std::size_t most) {
  const study::SuiteMethod* leader = leaderOf(statistics);
  Table table{.kind = "suite-scenes",
              .columns = {column("Scene", Q::name),
                          column("Median of the methods", Q::percent,
                                 "median error of the methods with a rank"),
                          column(leader == nullptr ? "First" : leader->label, Q::percent,
                                 "error of the method of rank 1"),
                          column("Best there", Q::text), column("Its error", Q::percent),
                          column("Truth ±", Q::percent)}};
  for (const study::SuiteScene& scene : statistics.scenes) {
    if (table.rows.size() == most) break;
    Cell name = textCell(scene.name);
    name.link = scene.report;
    name.note = scene.title;
    table.rows.push_back(
        {{name, valueCell(scene.median), valueCell(scene.leaderError), textCell(scene.best),
          valueCell(scene.bestError), valueCell(scene.uncertainty)}});
  }
  return table;
}

Table suiteBinsTable(const study::SuiteStatistics& statistics, const std::string& axis) {
  Table table{.kind = "regions", .columns = {column("Method", Q::name)}};
  std::vector<Ends> ends;
  double worst = 0;
  for (const study::SuiteBin& bin : statistics.bins) {
    if (bin.axis != axis) continue;
    appendOnce(ends, Ends{bin.low, bin.high});
    worst = std::max(worst, bin.error.errorRate);
  }
  std::sort(ends.begin(), ends.end());
  for (const auto& [low, high] : ends) {
    table.columns.push_back(column(binText(low, high), Q::percent));
  }
  for (const study::SuiteMethod& method : statistics.methods) {
    Row row{{textCell(method.label)}};
    for (const Ends& place : ends) {
      const auto found = std::find_if(statistics.bins.begin(), statistics.bins.end(),
                                      [&](const study::SuiteBin& bin) {
                                        return bin.method == method.label && bin.axis == axis &&
                                               Ends{bin.low, bin.high} == place;
                                      });
      row.cells.push_back(binCell(found == statistics.bins.end() ? nullptr : &*found, worst));
    }
    if (!ends.empty()) table.rows.push_back(std::move(row));
  }
  return table;
}

Table suiteResultsTable(const study::SuiteStatistics& statistics,
                        std::span<const study::StudyMeans> studies) {
  Table table{.kind = "results",
              .columns = {{"scene"},
                          {"method"},
                          {"error_rate", "", Q::exact},
                          {"false_shadow", "", Q::exact},
                          {"false_light", "", Q::exact},
                          {"uncertainty", "", Q::exact},
                          {"rank", "", Q::exact}}};
  const compare::SceneTable& scenes = statistics.table;
  for (std::size_t s = 0; s < scenes.scenes.size(); ++s) {
    const auto study =
        std::find_if(studies.begin(), studies.end(), [&](const study::StudyMeans& other) {
          return other.name == scenes.scenes[s] && other.suite == statistics.suite;
        });
    if (study == studies.end()) continue;
    const std::map<std::string, std::size_t> ranks = ranksOn(scenes, s);
    for (const std::string& label : scenes.methods) {
      const study::MethodMeans* means = study::findMeans(*study, label);
      const auto rank = ranks.find(label);
      if (means == nullptr) continue;
      const bool isWhole = rank != ranks.end();
      const auto known = [&](const std::optional<double>& value) {
        return valueCell(isWhole ? value : std::nullopt);
      };
      table.rows.push_back(
          {{textCell(study->name), textCell(label), known(means->errorRate),
            known(means->falseShadow), known(means->falseLight), valueCell(means->uncertainty),
            known(isWhole ? std::optional(static_cast<double>(rank->second)) : std::nullopt)}});
    }
  }
  return table;
}

}  // namespace gnomon::report
