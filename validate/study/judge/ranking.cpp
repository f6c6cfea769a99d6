#include "study/judge/ranking.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "common/error.h"
#include "common/lists.h"
#include "compare/counts.h"
#include "study/judge/claims.h"
#include "study/record/cases.h"
#include "study/spec/resolved_study.h"

namespace gnomon::study {

namespace {

/// One axis of a method.
using AxisKey = std::pair<std::string, std::string>;

AxisKey keyOf(const BinRecord& bin) {
  return {bin.method, bin.axis};
}

/// All lights together.
bool isCounted(const BinRecord& bin) {
  return bin.light == allLights && bin.counts.total() > 0;
}

}  // namespace

std::string suiteNameOf(const StudyRecord& record) {
  return record.reproduction.settings["study"]["suite"].value_or(std::string());
}

std::vector<SceneBin> sceneBins(const StudyRecord& record) {
  std::map<AxisKey, std::map<std::string, double>> viewWeights;
  for (const BinRecord& bin : record.bins) {
    if (isCounted(bin)) viewWeights[keyOf(bin)][bin.view] += bin.counts.total();
  }
  std::vector<SceneBin> bins;
  for (const BinRecord& bin : record.bins) {
    if (!isCounted(bin)) continue;
    const auto& views = viewWeights.at(keyOf(bin));
    const double all = views.at(bin.view) * static_cast<double>(views.size());
    auto found = std::find_if(bins.begin(), bins.end(), [&](const SceneBin& other) {
      return other.method == bin.method && other.axis == bin.axis && other.low == bin.low &&
             other.high == bin.high;
    });
    if (found == bins.end()) {
      found = bins.insert(bins.end(), {bin.method, bin.axis, bin.low, bin.high, {}});
    }
    found->share.weight += bin.counts.total() / all;
    found->share.wrong += (bin.counts.falsePositive + bin.counts.falseNegative) / all;
  }
  return bins;
}

namespace {

/// A label without a method of its own is its name.
MethodRecord methodOf(const StudyRecord& record, const std::string& label) {
  for (const MethodRecord& method : record.methods) {
    if (method.label == label) return method;
  }
  return {label, label, "", ""};
}

/// A method's figures over the steps of a sweep.
MethodMeans meanOver(std::span<const StudyMeans> steps, const std::string& label) {
  MethodMeans mean;
  mean.label = label;
  const auto over = [&](std::optional<double> MethodMeans::*figure) {
    std::vector<std::optional<double>> values;
    for (const StudyMeans& step : steps) {
      const MethodMeans* means = findMeans(step, label);
      if (means != nullptr) {
        mean.name = means->name;
        mean.mark = means->mark;
      }
      values.push_back(means == nullptr ? std::nullopt : means->*figure);
    }
    return meanOf(values);
  };
  mean.errorRate = over(&MethodMeans::errorRate);
  mean.falseShadow = over(&MethodMeans::falseShadow);
  mean.falseLight = over(&MethodMeans::falseLight);
  mean.uncertainty = over(&MethodMeans::uncertainty);
  for (const StudyMeans& step : steps) {
    const MethodMeans* means = findMeans(step, label);
    const std::vector<std::optional<double>> errors =
        means != nullptr ? means->caseErrors : std::vector<std::optional<double>>(caseCount(step));
    mean.caseErrors.insert(mean.caseErrors.end(), errors.begin(), errors.end());
  }
  return mean;
}

/// Of every two labels of which at least one study has a difference: their mean over those. What
/// lacks an interval at a sweep's value says at which.
std::vector<DifferenceRecord> meanDifferences(std::span<const StudyMeans> steps,
                                              const std::vector<std::string>& labels) {
  std::vector<DifferenceRecord> means;
  for (std::size_t first = 0; first < labels.size(); ++first) {
    for (std::size_t second = first + 1; second < labels.size(); ++second) {
      std::vector<DifferenceRecord> found;
      for (const StudyMeans& step : steps) {
        auto difference = differenceIn(step, labels[first], labels[second]);
        if (!difference) continue;
        if (!isKnown(*difference)) {
          difference->reason = fmt::format("at {}: {}", stepValue(step.name), difference->reason);
        }
        found.push_back(std::move(*difference));
      }
      if (!found.empty()) means.push_back(meanDifference(found));
    }
  }
  return means;
}

/// In each case in which some method has an error rate.
std::vector<std::optional<double>> caseErrors(const StudyRecord& record, const std::string& label) {
  std::vector<std::optional<double>> errors;
  for (const Case& which : comparedCases(record)) {
    errors.push_back(rateOf(record, label, which, Answer::drawn, compare::metrics::errorRate));
  }
  return errors;
}

/// The truth's, over the rows; none where it was not measured.
std::optional<double> meanUncertainty(const StudyRecord& record,
                                      const std::vector<const ResultRecord*>& rows) {
  std::vector<std::optional<double>> values;
  values.reserve(rows.size());
  for (const ResultRecord* row : rows) {
    values.push_back(uncertaintyOf(record, {row->view, row->light}));
  }
  return meanOf(values);
}

MethodMeans meansOf(const StudyRecord& record, const std::string& label) {
  const std::vector<const ResultRecord*> rows = rankedRows(record, label, Answer::drawn);
  const auto mean = [&](compare::MetricId metric) {
    std::vector<std::optional<double>> values;
    values.reserve(rows.size());
    for (const ResultRecord* row : rows) values.push_back(compare::rate(row->counts, metric).value);
    return meanOf(values);
  };
  std::set<std::string> views;
  for (const ResultRecord* row : rows) views.insert(row->view);
  const MethodRecord method = methodOf(record, label);
  return {label,
          method.name,
          mean(compare::metrics::errorRate),
          mean(compare::metrics::falseShadow),
          mean(compare::metrics::falseLight),
          meanUncertainty(record, rows),
          caseErrors(record, label),
          meanInterval(record, label, views),
          method.mark};
}

}  // namespace

std::size_t MethodMeans::cases() const {
  return static_cast<std::size_t>(
      std::count_if(caseErrors.begin(), caseErrors.end(), [](const auto& e) { return bool(e); }));
}

bool isSoft(const StudyRecord& record) {
  return std::any_of(record.results.begin(), record.results.end(),
                     [](const ResultRecord& result) { return !result.shares.empty(); });
}

bool isSoft(const SweepRecord& sweep) {
  return std::any_of(sweep.steps.begin(), sweep.steps.end(),
                     [](const StudyRecord& step) { return isSoft(step); });
}

StudyMeans studyMeans(const StudyRecord& record) {
  StudyMeans study{record.name, record.title, record.status(), {}, record.claims, {}};
  for (const std::string& label : methodsOf(record)) {
    study.methods.push_back(meansOf(record, label));
  }
  study.differences = differencesOverViews(record, methodsOf(record));
  study.suite = suiteNameOf(record);
  if (!study.suite.empty()) study.bins = sceneBins(record);
  study.isSoft = isSoft(record);
  return study;
}

StudyMeans studyMeans(const SweepRecord& sweep) {
  std::vector<StudyMeans> steps;
  for (const StudyRecord& step : sweep.steps) steps.push_back(studyMeans(step));
  StudyMeans study{sweep.name, sweep.title, sweep.status(), {}, sweep.claims, {}};
  const std::vector<std::string> labels = labelsOf(steps);
  for (const std::string& label : labels) study.methods.push_back(meanOver(steps, label));
  study.differences = meanDifferences(steps, labels);
  study.isSoft = isSoft(sweep);
  return study;
}

RunStatus statusOf(std::span<const StudyMeans> studies) {
  const auto has = [&](RunStatus status) {
    return std::any_of(studies.begin(), studies.end(),
                       [&](const StudyMeans& study) { return study.status == status; });
  };
  if (has(RunStatus::fail)) return RunStatus::fail;
  return has(RunStatus::pass) ? RunStatus::pass : RunStatus::notJudged;
}

std::optional<double> largestUncertainty(const StudyMeans& study) {
  std::optional<double> largest;
  for (const MethodMeans& method : study.methods) {
    if (method.uncertainty) largest = std::max(largest.value_or(0), *method.uncertainty);
  }
  return largest;
}

const MethodMeans* findMeans(const StudyMeans& study, std::string_view label) {
  const auto found = std::find_if(study.methods.begin(), study.methods.end(),
                                  [&](const MethodMeans& m) { return m.label == label; });
  return found == study.methods.end() ? nullptr : &*found;
}

std::string labelWithCases(const MethodMeans& method) {
  if (method.isInEveryCase()) return method.label;
  return fmt::format("{} ({} of {} cases)", method.label, method.cases(), method.caseErrors.size());
}

std::vector<std::string> labelsOf(std::span<const StudyMeans> studies) {
  std::vector<std::string> labels;
  for (const StudyMeans& study : studies) {
    for (const MethodMeans& method : study.methods) appendOnce(labels, method.label);
  }
  return labels;
}

std::optional<double> meanOf(const std::vector<std::optional<double>>& values) {
  double sum = 0;
  for (const auto& value : values) {
    if (!value) return std::nullopt;
    sum += *value;
  }
  return values.empty() ? std::nullopt : std::optional(sum / static_cast<double>(values.size()));
}

std::size_t caseCount(const StudyMeans& study) {
  return study.methods.empty() ? 0 : study.methods.front().caseErrors.size();
}

std::optional<DifferenceRecord> differenceIn(const StudyMeans& study, std::string_view first,
                                             std::string_view second) {
  for (const DifferenceRecord& row : study.differences) {
    if (row.first == first && row.second == second) return row;
    if (row.first == second && row.second == first) return swapped(row);
  }
  return std::nullopt;
}

std::vector<const ResultRecord*> rankedRows(const StudyRecord& record, std::string_view method,
                                            Answer answer) {
  std::vector<const ResultRecord*> rows;
  for (const Case& which : comparedCases(record)) {
    if (!rateOf(record, method, which, Answer::drawn, compare::metrics::errorRate)) continue;
    if (const auto* row = findResult(record, method, which, wholeRegion, answer)) {
      rows.push_back(row);
    }
  }
  return rows;
}

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
