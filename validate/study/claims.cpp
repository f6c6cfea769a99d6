#include "study/claims.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include "study/result_metrics.h"

namespace gnomon {
namespace {

/// One light and view in which both methods have a value.
struct Pair {
  double less;
  double than;
  double uncertainty;
};

const ResultRecord* findResult(const StudyRecord& study, const std::string& method,
                               const ResultRecord& like, std::string_view region) {
  const auto found =
      std::find_if(study.results.begin(), study.results.end(), [&](const ResultRecord& result) {
        return result.method == method && result.light == like.light && result.view == like.view &&
               result.region == region && result.answer == like.answer;
      });
  return found == study.results.end() ? nullptr : &*found;
}

/// How many times more samples the view has than the result's region: so much larger is the share
/// of samples that flip, if all of them lie in it.
double concentration(const StudyRecord& study, const ResultRecord& result) {
  const ResultRecord* all = findResult(study, result.method, result, "all");
  if (all == nullptr || result.counts.samples == 0) return 1;
  return static_cast<double>(all->counts.samples) / static_cast<double>(result.counts.samples);
}

double uncertaintyOf(const StudyRecord& study, const ResultRecord& result,
                     const std::string& metric) {
  const auto& flips = study.truth.flips;
  const auto flip = std::find_if(flips.begin(), flips.end(), [&](const UncertaintyRecord& record) {
    return record.view == result.view && record.light == result.light;
  });
  if (!isRate(metric)) {
    return metricUncertainty(flip == flips.end() ? UncertaintyRecord{} : *flip, metric);
  }
  const double rate = flip == flips.end() ? study.truth.uncertainty : flip->flipRate;
  return rate * concentration(study, result);
}

std::optional<double> valueOf(const StudyRecord& study, const std::string& method,
                              const ResultRecord& like, const std::string& metric) {
  const ResultRecord* result = findResult(study, method, like, like.region);
  return result == nullptr ? std::nullopt : metricOf(*result, metric).value;
}

std::vector<Pair> pairs(const ClaimSpec& claim, const StudyRecord& study) {
  std::vector<Pair> found;
  for (const ResultRecord& result : study.results) {
    if (result.method != claim.less || result.region != claim.region ||
        result.answer != claim.answer) {
      continue;
    }
    const auto less = metricOf(result, claim.metric).value;
    const auto than = valueOf(study, claim.than, result, claim.metric);
    if (less && than) found.push_back({*less, *than, uncertaintyOf(study, result, claim.metric)});
  }
  return found;
}

double meanGain(const std::vector<Pair>& found) {
  double sum = 0;
  for (const Pair& pair : found) sum += pair.than - pair.less;
  return sum / static_cast<double>(found.size());
}

double largestUncertainty(const std::vector<Pair>& found) {
  double largest = 0;
  for (const Pair& pair : found) largest = std::max(largest, pair.uncertainty);
  return largest;
}

/// A difference as texts show it: rates in points of a hundred, all others as they are.
std::string differenceText(const std::string& metric, double difference) {
  return isRate(metric) ? fmt::format("{:.2f} points", 100 * difference)
                        : fmt::format("{:.3f}", difference);
}

std::string regionText(const ClaimSpec& claim) {
  return claim.region == "all" ? "" : fmt::format(" in the region {}", claim.region);
}

/// Whether a difference is above nothing by more than the uncertainty.
Verdict judgeDifference(double difference, double uncertainty) {
  return difference > uncertainty    ? Verdict::held
         : difference < -uncertainty ? Verdict::failed
                                     : Verdict::notDistinguishable;
}

ClaimRecord judgeOrder(const ClaimSpec& claim, const std::vector<Pair>& found) {
  const auto smaller = std::count_if(found.begin(), found.end(), [](const Pair& pair) {
    return pair.less < pair.than - pair.uncertainty;
  });
  const auto larger = std::count_if(found.begin(), found.end(), [](const Pair& pair) {
    return pair.less > pair.than + pair.uncertainty;
  });
  const auto all = static_cast<std::ptrdiff_t>(found.size());
  const Verdict verdict = larger > 0       ? Verdict::failed
                          : smaller == all ? Verdict::held
                                           : Verdict::notDistinguishable;
  return {claim.text, claim.source, verdict,
          fmt::format("{} of {} smaller than of {}{} in {} of {} comparisons, larger in {}; "
                      "mean difference {}",
                      claim.metric, claim.less, claim.than, regionText(claim), smaller, all, larger,
                      differenceText(claim.metric, meanGain(found)))};
}

ClaimRecord judgeGain(const ClaimSpec& claim, const StudyRecord& study, const StudyRecord& other) {
  const auto here = pairs(claim, study);
  const auto there = pairs(claim, other);
  if (there.empty()) {
    return {claim.text, claim.source, Verdict::notEvaluated,
            fmt::format("{} has no results of {} and {}", other.name, claim.less, claim.than)};
  }
  const double difference = meanGain(here) - meanGain(there);
  const double uncertainty = largestUncertainty(here) + largestUncertainty(there);
  return {claim.text, claim.source, judgeDifference(difference, uncertainty),
          fmt::format("mean gain in {}{} {} here, {} in {}", claim.metric, regionText(claim),
                      differenceText(claim.metric, meanGain(here)),
                      differenceText(claim.metric, meanGain(there)), other.name)};
}

// ---- one method against bounds

/// What one light and view says of a metric.
struct Bounded {
  double value;
  double uncertainty;
};

bool isWithin(const ClaimSpec& claim, const Bounded& found) {
  return (!claim.above || found.value - found.uncertainty > *claim.above) &&
         (!claim.below || found.value + found.uncertainty < *claim.below);
}

bool isOutside(const ClaimSpec& claim, const Bounded& found) {
  return (claim.above && found.value + found.uncertainty <= *claim.above) ||
         (claim.below && found.value - found.uncertainty >= *claim.below);
}

std::string boundsText(const ClaimSpec& claim) {
  if (!claim.below) return fmt::format("above {}", *claim.above);
  if (!claim.above) return fmt::format("below {}", *claim.below);
  return fmt::format("between {} and {}", *claim.above, *claim.below);
}

ClaimRecord judgeBounds(const ClaimSpec& claim, const StudyRecord& study) {
  std::vector<Bounded> found;
  std::size_t cases = 0;
  for (const ResultRecord& result : study.results) {
    if (result.method != claim.method || result.region != claim.region ||
        result.answer != claim.answer) {
      continue;
    }
    ++cases;
    if (const auto value = metricOf(result, claim.metric).value) {
      found.push_back({*value, uncertaintyOf(study, result, claim.metric)});
    }
  }
  if (found.empty()) {
    return {claim.text, claim.source, Verdict::notEvaluated,
            fmt::format("{} is not defined for {}", claim.metric, claim.method)};
  }
  const auto within = std::count_if(found.begin(), found.end(),
                                    [&](const Bounded& b) { return isWithin(claim, b); });
  const auto outside = std::count_if(found.begin(), found.end(),
                                     [&](const Bounded& b) { return isOutside(claim, b); });
  const Verdict verdict = outside > 0 ? Verdict::failed
                          : within == static_cast<std::ptrdiff_t>(found.size())
                              ? Verdict::held
                              : Verdict::notDistinguishable;
  const auto [least, most] =
      std::minmax_element(found.begin(), found.end(),
                          [](const Bounded& a, const Bounded& b) { return a.value < b.value; });
  const std::string left =
      found.size() == cases ? "" : fmt::format(", not defined in {} more", cases - found.size());
  return {claim.text, claim.source, verdict,
          fmt::format("{} of {}{} {} in {} of {} cases, outside in {}{}; found {:.3f} to {:.3f}",
                      claim.metric, claim.method, regionText(claim), boundsText(claim), within,
                      found.size(), outside, left, least->value, most->value)};
}

/// The gain at the last value of a sweep against that at the first.
ClaimRecord judgeGrowth(const ClaimSpec& claim, const SweepRecord& sweep) {
  const StudyRecord& first = sweep.steps.front();
  const StudyRecord& last = sweep.steps.back();
  const auto atFirst = pairs(claim, first);
  const auto atLast = pairs(claim, last);
  if (atFirst.empty() || atLast.empty()) {
    return {claim.text, claim.source, Verdict::notEvaluated,
            fmt::format("{} is not defined for {} and {} at the first and last value", claim.metric,
                        claim.less, claim.than)};
  }
  const double growth = meanGain(atLast) - meanGain(atFirst);
  return {
      claim.text, claim.source,
      judgeDifference(growth, largestUncertainty(atLast) + largestUncertainty(atFirst)),
      fmt::format("mean gain in {}{} {} at {} = {}, {} at {}", claim.metric, regionText(claim),
                  differenceText(claim.metric, meanGain(atLast)), sweep.key, sweep.values.back(),
                  differenceText(claim.metric, meanGain(atFirst)), sweep.values.front())};
}

/// A claim that each step has judged for itself.
ClaimRecord judgeOverSteps(const ClaimSpec& claim, const SweepRecord& sweep, std::size_t index) {
  std::array<std::vector<double>, 4> values;  // a verdict
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const Verdict verdict = sweep.steps[i].claims.at(index).verdict;
    values.at(static_cast<std::size_t>(verdict)).push_back(sweep.values[i]);
  }
  const auto at = [&](Verdict verdict) { return values.at(static_cast<std::size_t>(verdict)); };
  std::string detail;
  const auto tell = [&](const char* name, Verdict verdict) {
    if (at(verdict).empty()) return;
    detail +=
        fmt::format("{}{} at {}", detail.empty() ? "" : "; ", name, fmt::join(at(verdict), ", "));
  };
  tell("held", Verdict::held);
  tell("failed", Verdict::failed);
  tell("not distinguishable", Verdict::notDistinguishable);
  tell("not evaluated", Verdict::notEvaluated);
  const Verdict verdict = !at(Verdict::failed).empty()                     ? Verdict::failed
                          : at(Verdict::held).size() == sweep.steps.size() ? Verdict::held
                          : !at(Verdict::notDistinguishable).empty() ? Verdict::notDistinguishable
                                                                     : Verdict::notEvaluated;
  return {claim.text, claim.source, verdict, fmt::format("{}: {}", sweep.key, detail)};
}

ClaimRecord judge(const ClaimSpec& claim, std::span<const StudyRecord> run, std::size_t own) {
  if (!claim.method.empty()) return judgeBounds(claim, run[own]);
  if (claim.gainGrows) {
    return {claim.text, claim.source, Verdict::notEvaluated, "judged over the values of the sweep"};
  }
  const auto found = pairs(claim, run[own]);
  if (found.empty()) {
    return {claim.text, claim.source, Verdict::notEvaluated,
            fmt::format("{} is not defined for {} and {}", claim.metric, claim.less, claim.than)};
  }
  if (claim.gainExceeds.empty()) return judgeOrder(claim, found);
  const auto other = std::find_if(run.begin(), run.end(), [&](const StudyRecord& study) {
    return study.name == claim.gainExceeds;
  });
  if (other == run.end()) {
    return {claim.text, claim.source, Verdict::notEvaluated,
            fmt::format("needs the study {} in the same run", claim.gainExceeds)};
  }
  return judgeGain(claim, run[own], *other);
}

}  // namespace

std::vector<ClaimRecord> judgeClaims(const std::vector<ClaimSpec>& claims,
                                     std::span<const StudyRecord> run, std::size_t own) {
  std::vector<ClaimRecord> records;
  records.reserve(claims.size());
  for (const ClaimSpec& claim : claims) records.push_back(judge(claim, run, own));
  return records;
}

std::vector<ClaimRecord> judgeSweepClaims(const std::vector<ClaimSpec>& claims,
                                          const SweepRecord& sweep) {
  std::vector<ClaimRecord> records;
  records.reserve(claims.size());
  for (std::size_t i = 0; i < claims.size(); ++i) {
    records.push_back(claims[i].gainGrows ? judgeGrowth(claims[i], sweep)
                                          : judgeOverSteps(claims[i], sweep, i));
  }
  return records;
}

}  // namespace gnomon
