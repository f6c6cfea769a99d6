#include "study/judge/ranking.h"

#include <algorithm>
#include <set>

#include "compare/rates.h"
#include "study/judge/distinguish.h"
#include "study/judge/ranking_rule.h"
#include "study/record/cases.h"

namespace gnomon {
namespace {

using Rows = std::vector<const ResultRecord*>;

Mean meanOf(const Rows& rows, std::string_view metric) {
  double sum = 0;
  std::size_t defined = 0;
  for (const ResultRecord* row : rows) {
    if (const auto value = rate(row->counts, metric).value) {
      sum += *value;
      ++defined;
    }
  }
  if (defined == 0) return {};
  return {sum / static_cast<double>(defined), defined};
}

std::optional<double> meanUncertainty(const StudyRecord& record, const Rows& rows) {
  double sum = 0;
  for (const ResultRecord* row : rows) {
    const auto flips = uncertaintyOf(record, {row->view, row->light});
    if (!flips) return std::nullopt;
    sum += *flips;
  }
  return rows.empty() ? std::nullopt : std::optional(sum / static_cast<double>(rows.size()));
}

Rows rowsOf(const StudyRecord& record, const std::string& label, const std::vector<Case>& cases,
            Answer answer) {
  Rows rows;
  for (const Case& which : cases) {
    if (const auto* row = findResult(record, label, which, wholeRegion, answer)) {
      rows.push_back(row);
    }
  }
  return rows;
}

/// Those of the cases in which the method has an error rate.
std::vector<Case> casesOfMethod(const StudyRecord& record, const std::string& label,
                                std::vector<Case> cases) {
  std::erase_if(cases, [&](const Case& which) {
    return !rateOf(record, label, which, Answer::drawn, "error_rate");
  });
  return cases;
}

RankedMethod summarise(const StudyRecord& record, const std::string& label,
                       const std::vector<Case>& all) {
  const std::vector<Case> cases = casesOfMethod(record, label, all);
  const Rows rows = rowsOf(record, label, cases, Answer::drawn);
  RankedMethod method;
  method.label = label;
  method.cases = rows.size();
  method.allCases = all.size();
  method.errorRate = meanOf(rows, "error_rate");
  method.falseShadow = meanOf(rows, "false_shadow");
  method.falseLight = meanOf(rows, "false_light");
  method.iou = meanOf(rows, "iou");
  method.ber = meanOf(rows, "ber");
  method.testError = meanOf(rowsOf(record, label, cases, Answer::test), "error_rate");
  method.uncertainty = meanUncertainty(record, rows);
  std::set<std::string> views;
  for (const ResultRecord* row : rows) views.insert(row->view);
  method.interval = meanInterval(record, label, views);
  return method;
}

std::vector<RankedMethod> inRankingOrder(const std::vector<RankedMethod>& methods,
                                         std::size_t cases) {
  std::vector<RankingEntry> entries;
  for (const RankedMethod& method : methods) {
    entries.push_back({method.errorRate.value, method.cases});
  }
  std::vector<RankedMethod> ranked;
  for (const RankingPlace& place : rankByError(entries, cases)) {
    ranked.push_back(methods[place.entry]);
    ranked.back().rank = place.rank;
  }
  return ranked;
}

/// What the means of methods without a rank may be compared with.
void setLeaderErrors(const StudyRecord& record, const std::vector<Case>& cases,
                     std::vector<RankedMethod>& ranked) {
  if (ranked.empty() || !ranked.front().rank) return;
  for (RankedMethod& method : ranked) {
    if (method.rank) continue;
    const std::vector<Case> own = casesOfMethod(record, method.label, cases);
    method.leaderError =
        meanOf(rowsOf(record, ranked.front().label, own, Answer::drawn), "error_rate").value;
  }
}

void markIndistinguishable(const StudyRecord& record, std::vector<RankedMethod>& ranked) {
  for (RankedMethod& method : ranked) {
    for (const RankedMethod& other : ranked) {
      if (&other == &method) continue;
      const auto difference = differenceOverViews(record, method.label, other.label);
      if (difference && difference->verdict == DifferenceVerdict::notDistinguishable) {
        method.indistinguishable.push_back(other.label);
      }
    }
  }
}

}  // namespace

std::vector<RankedMethod> rankMethods(const StudyRecord& record) {
  const std::vector<Case> cases = comparedCases(record);
  std::vector<RankedMethod> methods;
  for (const std::string& label : methodsOf(record)) {
    methods.push_back(summarise(record, label, cases));
  }
  std::vector<RankedMethod> ranked = inRankingOrder(methods, cases.size());
  setLeaderErrors(record, cases, ranked);
  markIndistinguishable(record, ranked);
  return ranked;
}

}  // namespace gnomon
