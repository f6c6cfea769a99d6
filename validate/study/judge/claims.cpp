#include "study/judge/claims.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "study/judge/distinguish.h"
#include "study/record/claim_spread.h"
#include "study/record/result_metrics.h"

namespace gnomon {
namespace {

/// One light and view in which both methods have a value.
struct Pair {
  const ResultRecord* result;  ///< of `less`
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
    if (less && than)
      found.push_back({&result, *less, *than, uncertaintyOf(study, result, claim.metric)});
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

/// Whether the claim's metric has intervals: the score does.
bool hasIntervals(const ClaimSpec& claim) {
  return claim.metric == "error_rate" && claim.region == "all" && claim.answer == Answer::drawn;
}

std::string intervalNote(const ClaimSpec& claim) {
  return hasIntervals(claim)
             ? ""
             : "; no interval exists for it, judged by the truth’s uncertainty alone";
}

ClaimRecord notEvaluated(const ClaimSpec& claim, std::string detail) {
  return {claim.text, claim.source, Verdict::notEvaluated, std::move(detail)};
}

/// Of a number that should be above 0.
Verdict signVerdict(DifferenceVerdict verdict) {
  return verdict == DifferenceVerdict::worse    ? Verdict::held
         : verdict == DifferenceVerdict::better ? Verdict::failed
                                                : Verdict::notDistinguishable;
}

/// Of the other sign.
Verdict opposite(Verdict verdict) {
  return verdict == Verdict::held     ? Verdict::failed
         : verdict == Verdict::failed ? Verdict::held
                                      : verdict;
}

/// A claim over its cases.
class Cases {
 public:
  Cases(const ClaimSpec& claim, const char* quantity) {
    spread_.quantity = quantity;
    spread_.hasIntervals = hasIntervals(claim);
  }

  /// @param quantity  none where the case has none
  void add(const ResultRecord& result, Verdict verdict, std::optional<double> quantity) {
    ++spread_.cases;
    spread_.held += verdict == Verdict::held ? 1 : 0;
    spread_.failed += verdict == Verdict::failed ? 1 : 0;
    views_.insert(result.view);
    if (quantity) quantities_.push_back(*quantity);
  }

  [[nodiscard]] ClaimSpread spread() const {
    ClaimSpread spread = spread_;
    spread.views = views_.size();
    spread.quartiles = quartilesOf(quantities_);
    return spread;
  }

 private:
  ClaimSpread spread_;
  std::set<std::string> views_;
  std::vector<double> quantities_;
};

Verdict verdictOver(const ClaimSpread& spread) {
  if (spread.failed > 0) return Verdict::failed;
  if (spread.together) return *spread.together;
  return spread.held == spread.cases ? Verdict::held : Verdict::notDistinguishable;
}

/// Whether `less` is smaller in one case.
Verdict judgePair(const ClaimSpec& claim, const StudyRecord& study, const Pair& pair) {
  if (!hasIntervals(claim)) {
    return signVerdict(verdictByTruth(pair.than - pair.less, pair.uncertainty));
  }
  const auto difference =
      differenceOf(study, pair.result->view, pair.result->light, claim.than, claim.less);
  return difference ? signVerdict(difference->verdict) : Verdict::notDistinguishable;
}

/// Whether `less` is smaller on average over all cases.
Verdict judgeTogether(const ClaimSpec& claim, const StudyRecord& study) {
  const auto mean = differenceOverViews(study, claim.than, claim.less);
  return mean ? signVerdict(mean->verdict) : Verdict::notDistinguishable;
}

ClaimRecord judgeOrder(const ClaimSpec& claim, const StudyRecord& study,
                       const std::vector<Pair>& found) {
  Cases cases(claim, "ratio");
  for (const Pair& pair : found) {
    cases.add(*pair.result, judgePair(claim, study, pair),
              pair.than > 0 ? std::optional(pair.less / pair.than) : std::nullopt);
  }
  ClaimSpread spread = cases.spread();
  if (spread.hasIntervals && spread.cases > 1) spread.together = judgeTogether(claim, study);
  return {claim.text, claim.source, verdictOver(spread),
          fmt::format("{} of {} smaller than of {}{}: {}; mean difference {}{}", claim.metric,
                      claim.less, claim.than, regionText(claim), spreadText(spread),
                      differenceText(claim.metric, meanGain(found)), intervalNote(claim)),
          spread};
}

/// What `less` gains over `than` on average in a study.
struct Gain {
  double value;
  std::optional<Interval> interval;
  double uncertainty;
};

/// Over all of a study's records: several, where it has a sweep. None without any case.
std::optional<Gain> gainOf(const ClaimSpec& claim, const std::vector<const StudyRecord*>& records) {
  std::vector<Pair> found;
  std::vector<DifferenceRecord> differences;
  for (const StudyRecord* record : records) {
    const std::vector<Pair> more = pairs(claim, *record);
    found.insert(found.end(), more.begin(), more.end());
    const auto mean = differenceOverViews(*record, claim.than, claim.less);
    if (mean) differences.push_back(*mean);
  }
  if (found.empty()) return std::nullopt;
  const auto interval =
      differences.size() == records.size() ? meanDifference(differences).interval : std::nullopt;
  return Gain{meanGain(found), interval, largestUncertainty(found)};
}

/// Of the difference of two independent gains.
std::optional<Interval> intervalOf(const Gain& first, const Gain& second) {
  if (!first.interval || !second.interval) return std::nullopt;
  const double difference = first.value - second.value;
  return Interval{difference - std::hypot(first.value - first.interval->low,
                                          second.interval->high - second.value),
                  difference + std::hypot(first.interval->high - first.value,
                                          second.value - second.interval->low)};
}

/// Whether one gain is above another.
Verdict judgeGains(const ClaimSpec& claim, const Gain& first, const Gain& second) {
  const double difference = first.value - second.value;
  const double uncertainty = first.uncertainty + second.uncertainty;
  return signVerdict(hasIntervals(claim)
                         ? verdictOn(difference, intervalOf(first, second), uncertainty)
                         : verdictByTruth(difference, uncertainty));
}

/// " (difference 0.10 to 1.20 points)", or why there is none.
std::string gainIntervalText(const ClaimSpec& claim, const Gain& first, const Gain& second) {
  if (!hasIntervals(claim)) return intervalNote(claim);
  const auto interval = intervalOf(first, second);
  return interval ? fmt::format("; 95 % interval of their difference {:.2f} to {:.2f} points",
                                100 * interval->low, 100 * interval->high)
                  : "; their difference has no interval";
}

/// Whether a record is that of a study, or of one value of its sweep, which is named NAME/VALUE.
bool isOfStudy(const StudyRecord& record, const std::string& name) {
  return record.name == name || record.name.starts_with(name + "/");
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
  const std::optional<Gain> own = gainOf(claim, {&study});
  const std::optional<Gain> there = gainOf(claim, others);
  if (!own || !there) {
    return notEvaluated(claim, fmt::format("{} has no results of {} and {}", claim.gainExceeds,
                                           claim.less, claim.than));
  }
  return {claim.text, claim.source, judgeGains(claim, *own, *there),
          fmt::format("mean gain in {}{} {} here, {} in {}{}", claim.metric, regionText(claim),
                      differenceText(claim.metric, own->value),
                      differenceText(claim.metric, there->value), claim.gainExceeds,
                      gainIntervalText(claim, *own, *there))};
}

// ---- one method against bounds

/// What one light and view says of a metric.
struct Bounded {
  double value;
  double uncertainty;
  std::optional<Interval> interval;
};

/// Whether the value is above a bound.
Verdict judgeAbove(const ClaimSpec& claim, const Bounded& found, double bound) {
  const double distance = found.value - bound;
  if (!hasIntervals(claim)) return signVerdict(verdictByTruth(distance, found.uncertainty));
  if (!found.interval) return Verdict::notDistinguishable;
  const Interval moved{found.interval->low - bound, found.interval->high - bound};
  return signVerdict(verdictOn(distance, moved, found.uncertainty));
}

/// Of every bound: failed where it fails at one, held where it holds at all.
Verdict judgeBounded(const ClaimSpec& claim, const Bounded& found) {
  std::vector<Verdict> verdicts;
  if (claim.above) verdicts.push_back(judgeAbove(claim, found, *claim.above));
  if (claim.below) verdicts.push_back(opposite(judgeAbove(claim, found, *claim.below)));
  const auto has = [&](Verdict verdict) {
    return std::find(verdicts.begin(), verdicts.end(), verdict) != verdicts.end();
  };
  return has(Verdict::failed)               ? Verdict::failed
         : has(Verdict::notDistinguishable) ? Verdict::notDistinguishable
                                            : Verdict::held;
}

/// The mean over views of what all lights together say; without an interval where a view has none.
/// @param cases  one or more: the claim's, for the truth's uncertainty
Bounded meanOf(const ClaimSpec& claim, const StudyRecord& study, const std::vector<Bounded>& cases,
               const std::set<std::string>& views) {
  Bounded mean{0, 0, Interval{}};
  for (const Bounded& found : cases) {
    mean.value += found.value / static_cast<double>(cases.size());
    mean.uncertainty += found.uncertainty / static_cast<double>(cases.size());
  }
  const auto count = static_cast<double>(views.size());
  for (const std::string& view : views) {
    const auto row = findConfidence(study, view, allLights, claim.method);
    if (!row || !row->interval) {
      mean.interval.reset();
    } else if (mean.interval) {
      mean.interval->low += row->interval->low / count;
      mean.interval->high += row->interval->high / count;
    }
  }
  return mean;
}

std::string boundsText(const ClaimSpec& claim) {
  if (!claim.below) return fmt::format("above {}", *claim.above);
  if (!claim.above) return fmt::format("below {}", *claim.below);
  return fmt::format("between {} and {}", *claim.above, *claim.below);
}

ClaimRecord judgeBounds(const ClaimSpec& claim, const StudyRecord& study) {
  Cases cases(claim, "value");
  std::vector<Bounded> all;
  std::set<std::string> views;
  std::size_t undefined = 0;
  for (const ResultRecord& result : study.results) {
    if (result.method != claim.method || result.region != claim.region ||
        result.answer != claim.answer) {
      continue;
    }
    const auto value = metricOf(result, claim.metric).value;
    if (!value) {
      ++undefined;
      continue;
    }
    const auto confidence = findConfidence(study, result.view, result.light, claim.method);
    const Bounded found{*value, uncertaintyOf(study, result, claim.metric),
                        confidence ? confidence->interval : std::nullopt};
    cases.add(result, judgeBounded(claim, found), value);
    all.push_back(found);
    views.insert(result.view);
  }
  ClaimSpread spread = cases.spread();
  if (spread.hasIntervals && spread.cases > 1) {
    spread.together = judgeBounded(claim, meanOf(claim, study, all, views));
  }
  if (spread.cases == 0) {
    return notEvaluated(claim, fmt::format("{} is not defined for {}", claim.metric, claim.method));
  }
  const std::string left = undefined == 0 ? "" : fmt::format(", not defined in {} more", undefined);
  return {claim.text, claim.source, verdictOver(spread),
          fmt::format("{} of {}{} {}: {}{}{}", claim.metric, claim.method, regionText(claim),
                      boundsText(claim), spreadText(spread), left, intervalNote(claim)),
          spread};
}

/// The gain at the last value of a sweep against that at the first.
ClaimRecord judgeGrowth(const ClaimSpec& claim, const SweepRecord& sweep) {
  const StudyRecord& first = sweep.steps.front();
  const StudyRecord& last = sweep.steps.back();
  const std::optional<Gain> before = gainOf(claim, {&first});
  const std::optional<Gain> after = gainOf(claim, {&last});
  if (!before || !after) {
    return notEvaluated(claim,
                        fmt::format("{} is not defined for {} and {} at the first and last value",
                                    claim.metric, claim.less, claim.than));
  }
  return {claim.text, claim.source, judgeGains(claim, *after, *before),
          fmt::format("mean gain in {}{} {} at {} = {}, {} at {}{}", claim.metric,
                      regionText(claim), differenceText(claim.metric, after->value), sweep.key,
                      sweep.values.back(), differenceText(claim.metric, before->value),
                      sweep.values.front(), gainIntervalText(claim, *after, *before))};
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
    return notEvaluated(claim, "judged over the values of the sweep");
  }
  const auto found = pairs(claim, run[own]);
  if (found.empty()) {
    return notEvaluated(claim, fmt::format("{} is not defined for {} and {}", claim.metric,
                                           claim.less, claim.than));
  }
  if (claim.gainExceeds.empty()) return judgeOrder(claim, run[own], found);
  return judgeGain(claim, run[own], run);
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
