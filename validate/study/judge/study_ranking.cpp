#include "study/judge/study_ranking.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/lists.h"
#include "study/judge/distinguish.h"
#include "study/judge/ranking.h"
#include "study/judge/ranking_rule.h"
#include "study/record/cases.h"

namespace gnomon {
namespace {

std::string nameOf(const StudyRecord& record, const std::string& label) {
  for (const MethodRecord& method : record.methods) {
    if (method.label == label) return method.name;
  }
  return label;
}

std::vector<std::string> labelsOf(std::span<const StudyMeans> studies) {
  std::vector<std::string> labels;
  for (const StudyMeans& study : studies) {
    for (const MethodMeans& method : study.methods) appendOnce(labels, method.label);
  }
  return labels;
}

/// The mean, if every value is known.
std::optional<double> meanOf(const std::vector<std::optional<double>>& values) {
  double sum = 0;
  for (const auto& value : values) {
    if (!value) return std::nullopt;
    sum += *value;
  }
  return values.empty() ? std::nullopt : std::optional(sum / static_cast<double>(values.size()));
}

/// The differences of two labels, turned to the order asked for: one a study that has it. What
/// lacks an interval at a sweep's value says at which.
std::vector<DifferenceRecord> differencesIn(std::span<const StudyMeans> studies,
                                            const std::string& first, const std::string& second) {
  std::vector<DifferenceRecord> found;
  for (const StudyMeans& study : studies) {
    const std::string value = stepValue(study.name);
    for (const DifferenceRecord& row : study.differences) {
      const bool isTurned = row.first == second && row.second == first;
      if (!isTurned && (row.first != first || row.second != second)) continue;
      found.push_back(isTurned ? swapped(row) : row);
      if (row.interval || value.empty()) continue;
      found.back().reason = fmt::format("at {}: {}", value, row.reason);
    }
  }
  return found;
}

/// In which some method has an error rate.
std::size_t caseCount(const StudyMeans& study) {
  return study.methods.empty() ? 0 : study.methods.front().caseErrors.size();
}

/// A method's figures over the steps of a sweep.
MethodMeans meanOver(std::span<const StudyMeans> steps, const std::string& label) {
  MethodMeans mean;
  mean.label = label;
  const auto over = [&](std::optional<double> MethodMeans::*figure) {
    std::vector<std::optional<double>> values;
    for (const StudyMeans& step : steps) {
      const MethodMeans* means = findMeans(step, label);
      if (means != nullptr) mean.name = means->name;
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

std::vector<DifferenceRecord> allDifferences(const StudyRecord& record) {
  std::vector<DifferenceRecord> all;
  const std::vector<std::string> labels = methodsOf(record);
  for (std::size_t first = 0; first < labels.size(); ++first) {
    for (std::size_t second = first + 1; second < labels.size(); ++second) {
      if (auto mean = differenceOverViews(record, labels[first], labels[second])) {
        all.push_back(std::move(*mean));
      }
    }
  }
  return all;
}

/// In each case in which some method has an error rate.
std::vector<std::optional<double>> caseErrors(const StudyRecord& record, const std::string& label) {
  std::vector<std::optional<double>> errors;
  for (const Case& which : comparedCases(record)) {
    errors.push_back(rateOf(record, label, which, Answer::drawn, "error_rate"));
  }
  return errors;
}

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

/// Why a method is not distinguishable from the best, as RankedOverStudies has it.
std::optional<std::string> whyClose(const std::string& best, const std::string& label,
                                    std::span<const StudyMeans> studies) {
  std::vector<DifferenceRecord> found;
  std::vector<std::string> without;
  for (const StudyMeans& study : studies) {
    const auto difference = differencesIn({&study, 1}, label, best);
    if (difference.empty()) return std::nullopt;
    found.push_back(difference.front());
    if (found.back().interval) continue;
    without.push_back(fmt::format("{} ({})", study.name, found.back().reason));
  }
  const Estimate mean = estimateOf(meanDifference(found));
  if (isDistinguishable(mean)) return std::nullopt;
  if (!mean.interval) {
    return fmt::format("no interval of the difference on {}", fmt::join(without, "; "));
  }
  return mean.interval->holds(0) ? "the interval of the difference holds 0"
                                 : "the difference is within the truth's uncertainty";
}

/// Says how a method compares with the first of a ranking.
void compareWithBest(RankedOverStudies& method, const RankedOverStudies& best,
                     std::span<const StudyMeans> studies) {
  if (method.rank) {
    if (*method.rank > 1) method.closeToBest = whyClose(best.label, method.label, studies);
  } else if (best.rank) {
    method.leaderError = meanWhere(studies, best.label, method.label);
  }
}

}  // namespace

std::size_t MethodMeans::cases() const {
  return static_cast<std::size_t>(
      std::count_if(caseErrors.begin(), caseErrors.end(), [](const auto& e) { return bool(e); }));
}

StudyMeans studyMeans(const StudyRecord& record) {
  StudyMeans study{record.name, record.title, record.status(), {}, record.claims, {}};
  const std::vector<RankedMethod> ranked = rankMethods(record);
  for (const std::string& label : methodsOf(record)) {
    const auto found = std::find_if(ranked.begin(), ranked.end(),
                                    [&](const RankedMethod& m) { return m.label == label; });
    study.methods.push_back({label, nameOf(record, label), found->errorRate.value,
                             found->falseShadow.value, found->falseLight.value, found->uncertainty,
                             caseErrors(record, label)});
  }
  study.differences = allDifferences(record);
  return study;
}

StudyMeans studyMeans(const SweepRecord& sweep) {
  std::vector<StudyMeans> steps;
  for (const StudyRecord& step : sweep.steps) steps.push_back(studyMeans(step));
  StudyMeans study{sweep.name, sweep.title, sweep.status(), {}, sweep.claims, {}};
  const std::vector<std::string> labels = labelsOf(steps);
  for (const std::string& label : labels) study.methods.push_back(meanOver(steps, label));
  for (std::size_t first = 0; first < labels.size(); ++first) {
    for (std::size_t second = first + 1; second < labels.size(); ++second) {
      const auto found = differencesIn(steps, labels[first], labels[second]);
      if (!found.empty()) study.differences.push_back(meanDifference(found));
    }
  }
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

std::vector<RankedOverStudies> rankOverStudies(std::span<const StudyMeans> studies) {
  std::size_t cases = 0;
  for (const StudyMeans& study : studies) cases += caseCount(study);
  std::vector<RankedOverStudies> methods;
  std::vector<RankingEntry> entries;
  for (const std::string& label : labelsOf(studies)) {
    methods.push_back(summarise(studies, label));
    methods.back().allCases = cases;
    entries.push_back({methods.back().meanError, methods.back().cases});
  }
  std::vector<RankedOverStudies> ranked;
  for (const RankingPlace& place : rankByError(entries, cases)) {
    ranked.push_back(methods[place.entry]);
    ranked.back().rank = place.rank;
    compareWithBest(ranked.back(), ranked.front(), studies);
  }
  return ranked;
}

std::string labelWithCases(const MethodMeans& method) {
  if (method.isInEveryCase()) return method.label;
  return fmt::format("{} ({} of {} cases)", method.label, method.cases(), method.caseErrors.size());
}

std::string labelWithName(const RankedOverStudies& method) {
  const bool plain =
      method.names.empty() || (method.names.size() == 1 && method.names.front() == method.label);
  return plain ? method.label : fmt::format("{} ({})", method.label, fmt::join(method.names, ", "));
}

}  // namespace gnomon
