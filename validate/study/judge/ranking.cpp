#include "study/judge/ranking.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "common/error.h"
#include "common/lists.h"
#include "compare/counts.h"
#include "study/judge/claims.h"
#include "study/spec/resolved_study.h"

namespace gnomon::study {

namespace {

RankedOverStudies summarise(std::span<const StudyMeans> studies, const std::string& label) {
  RankedOverStudies method;
  method.label = label;
  std::vector<std::optional<double>> errors, uncertainties;
  for (const StudyMeans& study : studies) {
    const MethodMeans* means = findMeans(study, label);
    if (means == nullptr) continue;
    appendOnce(method.names, means->name);
    if (!means->errorRate) continue;
    method.cases += means->cases();
    errors.push_back(means->errorRate);
    uncertainties.push_back(means->uncertainty);
    if (!method.worstError || *means->errorRate > *method.worstError) {
      method.worstError = means->errorRate;
      method.worstStudy = study.name;
    }
  }
  method.studies = errors.size();
  method.meanError = meanOf(errors);
  method.uncertainty = meanOf(uncertainties);
  return method;
}

/// The mean error rate of `leader`, which has one in every case, over the cases of `label`.
std::optional<double> meanWhere(std::span<const StudyMeans> studies, const std::string& leader,
                                const std::string& label) {
  std::vector<std::optional<double>> means;
  for (const StudyMeans& study : studies) {
    const MethodMeans* own = findMeans(study, label);
    const MethodMeans* best = findMeans(study, leader);
    if (own == nullptr || !own->errorRate) continue;
    std::vector<std::optional<double>> errors;
    for (std::size_t i = 0; i < own->caseErrors.size(); ++i) {
      if (own->caseErrors[i]) errors.push_back(best->caseErrors[i]);
    }
    means.push_back(meanOf(errors));
  }
  return meanOf(means);
}

/// The mean difference of a method to the best; none where a study has no difference.
std::optional<DifferenceRecord> differenceToBest(const std::string& method, const std::string& best,
                                                 std::span<const StudyMeans> studies) {
  std::vector<DifferenceRecord> found;
  for (const StudyMeans& study : studies) {
    auto difference = differenceIn(study, method, best);
    if (!difference) return std::nullopt;
    if (studies.size() > 1 && !isKnown(*difference)) {
      difference->reason = fmt::format("on {}: {}", study.name, difference->reason);
    }
    found.push_back(std::move(*difference));
  }
  return meanDifference(found);
}

/// Says how a method compares with the first of a ranking.
void compareWithBest(RankedOverStudies& method, const RankedOverStudies& best,
                     std::span<const StudyMeans> studies) {
  if (method.rank) {
    if (*method.rank > 1) method.toBest = differenceToBest(method.label, best.label, studies);
  } else if (best.rank) {
    method.leaderError = meanWhere(studies, best.label, method.label);
  }
}

}  // namespace

std::vector<RankedOverStudies> rankOverStudies(std::span<const StudyMeans> studies) {
  std::size_t cases = 0;
  for (const StudyMeans& study : studies) cases += caseCount(study);
  std::vector<RankedOverStudies> methods;
  for (const std::string& label : labelsOf(studies)) {
    methods.push_back(summarise(studies, label));
    methods.back().allCases = cases;
  }
  const auto unranked = std::stable_partition(
      methods.begin(), methods.end(),
      [&](const auto& method) { return method.meanError && method.cases == cases; });
  std::stable_sort(methods.begin(), unranked,
                   [](const auto& a, const auto& b) { return *a.meanError < *b.meanError; });
  std::stable_sort(unranked, methods.end(),
                   [](const auto& a, const auto& b) { return a.cases > b.cases; });
  for (auto method = methods.begin(); method != unranked; ++method) {
    method->rank = static_cast<std::size_t>(method - methods.begin()) + 1;
  }
  for (RankedOverStudies& method : methods) compareWithBest(method, methods.front(), studies);
  return methods;
}

std::string labelWithName(const std::string& label, const std::vector<std::string>& names) {
  const bool saysItself = names.empty() || (names.size() == 1 && label.starts_with(names.front()));
  return saysItself ? label : fmt::format("{} ({})", label, fmt::join(names, ", "));
}

namespace {

using Rows = std::vector<const ResultRecord*>;

Mean meanOver(const Rows& rows, compare::MetricId metric) {
  std::vector<std::optional<double>> defined;
  for (const ResultRecord* row : rows) {
    if (const auto value = compare::rate(row->counts, metric).value) defined.emplace_back(value);
  }
  return {meanOf(defined), defined.size()};
}

RankedMethod summarise(const StudyRecord& record, const StudyMeans& study,
                       const RankedOverStudies& place) {
  const Rows rows = rankedRows(record, place.label, Answer::drawn);
  return {place,
          *findMeans(study, place.label),
          meanOver(rows, compare::metrics::iou),
          meanOver(rows, compare::metrics::ber),
          meanOver(rankedRows(record, place.label, Answer::test), compare::metrics::errorRate),
          {}};
}

}  // namespace

std::vector<RankedMethod> rankMethods(const StudyRecord& record) {
  const StudyMeans study = studyMeans(record);
  const std::vector<RankedOverStudies> places = rankOverStudies({&study, 1});
  std::vector<RankedMethod> ranked;
  for (const RankedOverStudies& place : places) {
    ranked.push_back(summarise(record, study, place));
    for (const RankedOverStudies& other : places) {
      const auto difference = differenceIn(study, place.label, other.label);
      if (difference) ranked.back().like.add(other.label, difference->verdict);
    }
  }
  return ranked;
}

SweepRecord makeSweepRecord(const StudyPlan& plan, std::vector<StudyRecord> steps,
                            const std::string& command) {
  if (!plan.sweep || steps.size() != plan.sweep->cases.size()) {
    throw InternalError(
        fmt::format("sweep {}: {} records found, one a case expected", plan.name, steps.size()));
  }
  SweepRecord record{plan.name,        plan.title,
                     plan.source,      plan.steps.front().file.string(),
                     command,          studyCopyName(plan.name),
                     plan.sweep->keys, plan.sweep->cases,
                     std::move(steps), {}};
  record.claims = judgeSweepClaims(plan.steps.front().claims, record);
  return record;
}

}  // namespace gnomon::study
