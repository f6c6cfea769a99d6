#include "study/judge/gains.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "study/judge/claim_cases.h"

namespace gnomon::study {
namespace {

/// Whether the first gain is above the second.
Verdict judgeGains(const ClaimSpec& claim, const Estimate& first, const Estimate& second) {
  Estimate difference = gainDifference(first, second);
  if (!hasIntervals(claim)) difference = withoutInterval(difference.value, difference.uncertainty);
  return judgeWithin(difference, {0.0, std::nullopt});
}

/// "; 95 % interval of their difference 0.10 to 1.20 points", or why there is none.
std::string intervalText(const ClaimSpec& claim, const Estimate& first, const Estimate& second) {
  if (!hasIntervals(claim)) return intervalNote(claim);
  const auto interval = gainDifference(first, second).interval;
  return interval ? fmt::format("; 95 % interval of their difference {:.2f} to {:.2f} points",
                                100 * interval->low, 100 * interval->high)
                  : "; their difference has no interval";
}

/// Whether a record is that of a study, or of one value of its sweep, which is named NAME/VALUE.
bool isOfStudy(const StudyRecord& record, const std::string& name) {
  return record.name == name || record.name.starts_with(name + "/");
}

}  // namespace

std::optional<Estimate> gainOf(const ClaimSpec& claim,
                               std::span<const StudyRecord* const> records) {
  std::vector<ClaimCase> cases;
  std::vector<DifferenceRecord> differences;
  for (const StudyRecord* record : records) {
    const std::vector<ClaimCase> more = casesOf(claim, *record).defined;
    cases.insert(cases.end(), more.begin(), more.end());
    const auto mean = differenceOverViews(*record, claim.than, claim.less);
    if (mean) differences.push_back(*mean);
  }
  if (cases.empty()) return std::nullopt;
  Estimate gain{meanValue(cases), std::nullopt};
  if (differences.size() == records.size()) {
    const DifferenceRecord mean = meanDifference(differences);
    gain.areEqual = mean.verdict == DifferenceVerdict::equal;
    gain.interval = gain.areEqual ? compare::Interval{} : mean.interval;
  }
  for (const ClaimCase& one : cases) {
    gain.uncertainty = std::max(gain.uncertainty, one.estimate.uncertainty);
  }
  return gain;
}

Estimate gainDifference(const Estimate& first, const Estimate& second) {
  const double difference = first.value - second.value;
  Estimate estimate{difference, std::nullopt, first.uncertainty + second.uncertainty,
                    first.areEqual && second.areEqual};
  if (first.interval && second.interval) {
    estimate.interval =
        compare::Interval{difference - std::hypot(first.value - first.interval->low,
                                                  second.interval->high - second.value),
                          difference + std::hypot(first.interval->high - first.value,
                                                  second.value - second.interval->low)};
  }
  return estimate;
}

ClaimRecord judgeGain(const ClaimSpec& claim, const StudyRecord& study,
                      std::span<const StudyRecord> run) {
  std::vector<const StudyRecord*> others;
  for (const StudyRecord& other : run) {
    if (isOfStudy(other, claim.gainExceeds)) others.push_back(&other);
  }
  if (others.empty()) {
    return notEvaluated(claim,
                        fmt::format("needs the study {} in the same run", claim.gainExceeds));
  }
  const std::optional<Estimate> own = gainOf(claim, std::array{&study});
  const std::optional<Estimate> there = gainOf(claim, others);
  if (!own || !there) {
    return notEvaluated(claim, fmt::format("{} has no results of {} and {}", claim.gainExceeds,
                                           claim.less, claim.than));
  }
  return {claim.text, claim.source, judgeGains(claim, *own, *there),
          fmt::format("mean gain in {}{} {} here, {} in {}{}", claim.metric, regionText(claim),
                      differenceText(claim.metric, own->value),
                      differenceText(claim.metric, there->value), claim.gainExceeds,
                      intervalText(claim, *own, *there))};
}

ClaimRecord judgeGrowth(const ClaimSpec& claim, const SweepRecord& sweep) {
  const std::optional<Estimate> before = gainOf(claim, std::array{&sweep.steps.front()});
  const std::optional<Estimate> after = gainOf(claim, std::array{&sweep.steps.back()});
  if (!before || !after) {
    return notEvaluated(claim,
                        fmt::format("{} is not defined for {} and {} at the first and last value",
                                    claim.metric, claim.less, claim.than));
  }
  return {claim.text, claim.source, judgeGains(claim, *after, *before),
          fmt::format(
              "mean gain in {}{} {} at {} = {}, {} at {}{}", claim.metric, regionText(claim),
              differenceText(claim.metric, after->value), sweep.keys.front().key,
              sweep.cases.back().values.front().text, differenceText(claim.metric, before->value),
              sweep.cases.front().values.front().text, intervalText(claim, *after, *before))};
}

}  // namespace gnomon::study
