#include "study/claims.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include "compare/rates.h"

namespace gnomon {
namespace {

/// One light and view in which both methods have a value.
struct Pair {
  double less;
  double than;
  double uncertainty;
};

double uncertaintyOf(const StudyRecord& study, const ResultRecord& result) {
  for (const UncertaintyRecord& flip : study.truth.flips) {
    if (flip.view == result.view && flip.light == result.light) return flip.flipRate;
  }
  return study.truth.uncertainty;
}

std::optional<double> valueOf(const StudyRecord& study, const std::string& method,
                              const ResultRecord& like, const std::string& metric) {
  for (const ResultRecord& result : study.results) {
    if (result.method == method && result.light == like.light && result.view == like.view &&
        result.region == like.region) {
      return rate(result.counts, metric).value;
    }
  }
  return std::nullopt;
}

std::vector<Pair> pairs(const ClaimSpec& claim, const StudyRecord& study) {
  std::vector<Pair> found;
  for (const ResultRecord& result : study.results) {
    if (result.method != claim.less || result.region != "all") continue;
    const auto less = rate(result.counts, claim.metric).value;
    const auto than = valueOf(study, claim.than, result, claim.metric);
    if (less && than) found.push_back({*less, *than, uncertaintyOf(study, result)});
  }
  return found;
}

double meanGain(const std::vector<Pair>& found) {
  double sum = 0;
  for (const Pair& pair : found) sum += pair.than - pair.less;
  return sum / static_cast<double>(found.size());
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
          fmt::format("{} of {} smaller than of {} in {} of {} comparisons, larger in {}; "
                      "mean difference {:.2f} points",
                      claim.metric, claim.less, claim.than, smaller, all, larger,
                      100 * meanGain(found))};
}

ClaimRecord judgeGain(const ClaimSpec& claim, const StudyRecord& study, const StudyRecord& other) {
  const auto here = pairs(claim, study);
  const auto there = pairs(claim, other);
  if (there.empty()) {
    return {claim.text, claim.source, Verdict::notEvaluated,
            fmt::format("{} has no results of {} and {}", other.name, claim.less, claim.than)};
  }
  const double difference = meanGain(here) - meanGain(there);
  const double uncertainty = study.truth.uncertainty + other.truth.uncertainty;
  return {claim.text, claim.source, judgeDifference(difference, uncertainty),
          fmt::format("mean gain in {} {:.2f} points here, {:.2f} in {}", claim.metric,
                      100 * meanGain(here), 100 * meanGain(there), other.name)};
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
  return {claim.text, claim.source,
          judgeDifference(growth, last.truth.uncertainty + first.truth.uncertainty),
          fmt::format("mean gain in {} {:.2f} points at {} = {}, {:.2f} at {}", claim.metric,
                      100 * meanGain(atLast), sweep.key, sweep.values.back(),
                      100 * meanGain(atFirst), sweep.values.front())};
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
