#include "study/judge/claims.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <array>
#include <numeric>
#include <set>
#include <type_traits>
#include <utility>

#include "study/record/cases.h"

namespace gnomon::study {

namespace {

/// How many cases have each verdict, by its place in the enumeration.
using VerdictCounts = std::array<std::size_t, 6>;

/// A case without an interval leaves the whole open only where all others are held, or not judged:
/// else it is not for want of an interval that the claim does not hold.
Verdict verdictOver(const VerdictCounts& counts) {
  const auto has = [&](Verdict verdict) { return counts.at(static_cast<std::size_t>(verdict)); };
  const std::size_t all = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  if (has(Verdict::failed) > 0) return Verdict::failed;
  if (has(Verdict::held) == all) return Verdict::held;
  if (has(Verdict::equal) == all) return Verdict::equal;
  if (has(Verdict::equal) + has(Verdict::notDistinguishable) > 0) {
    return Verdict::notDistinguishable;
  }
  return has(Verdict::noInterval) > 0 ? Verdict::noInterval : Verdict::notEvaluated;
}

Verdict verdictOver(const ClaimSpread& spread) {
  if (spread.failed == 0 && spread.together) return *spread.together;
  return verdictOver(VerdictCounts{spread.held, spread.failed, spread.equal,
                                   spread.notDistinguishable(), spread.withoutInterval, 0});
}

/// "below 0.05", "between 0.95 and 1.05".
std::string boundsText(const ClaimSpec& claim) {
  if (!claim.below) return fmt::format("above {}", *claim.above);
  if (!claim.above) return fmt::format("below {}", *claim.below);
  return fmt::format("between {} and {}", *claim.above, *claim.below);
}

/// What is claimed of two methods or of one, and over which cases it was judged.
std::string detailOf(const ClaimSpec& claim, const ClaimCases& cases, const ClaimSpread& spread) {
  if (claim.method.empty()) {
    return fmt::format("{} of “{}” less than that of “{}”{}: {}; mean difference {}{}",
                       claim.metric.name(), claim.less, claim.than, regionText(claim),
                       spreadText(spread), differenceText(claim.metric, meanValue(cases.defined)),
                       intervalNote(claim));
  }
  const std::string left =
      cases.undefined == 0 ? "" : fmt::format(", not defined in {} more", cases.undefined);
  return fmt::format("{} of “{}”{} {}: {}{}{}", claim.metric.name(), claim.method,
                     regionText(claim), boundsText(claim), spreadText(spread), left,
                     intervalNote(claim));
}

ClaimRecord judge(const ClaimSpec& claim, const StudyRecord& study) {
  const ClaimCases cases = casesOf(claim, study);
  if (cases.defined.empty()) {
    const std::string methods = claim.method.empty()
                                    ? fmt::format("“{}” and “{}”", claim.less, claim.than)
                                    : fmt::format("“{}”", claim.method);
    return notEvaluated(claim,
                        fmt::format("{} is not defined for {}", claim.metric.name(), methods));
  }
  const ClaimSpread spread = spreadOver(claim, study, cases.defined);
  return {claim.text, claim.source, verdictOver(spread), detailOf(claim, cases, spread), spread};
}

std::vector<std::string> methodsOf(const ClaimSpec& claim) {
  if (!claim.method.empty()) return {claim.method};
  return {claim.less, claim.than};
}

/// A claim that each step has judged for itself.
ClaimRecord judgeOverSteps(const ClaimSpec& claim, const SweepRecord& sweep, std::size_t index) {
  std::array<std::vector<std::size_t>, VerdictCounts{}.size()> cases;  // a verdict
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const Verdict verdict = sweep.steps[i].claims.at(index).verdict;
    cases.at(static_cast<std::size_t>(verdict)).push_back(i);
  }
  std::string detail;
  VerdictCounts counts{};
  for (std::size_t v = 0; v < counts.size(); ++v) {
    counts.at(v) = cases.at(v).size();
    if (cases.at(v).empty()) continue;
    detail += fmt::format("{}{} at {}", detail.empty() ? "" : "; ",
                          verdictName(static_cast<Verdict>(v)), sweep.casesText(cases.at(v)));
  }
  return {claim.text, claim.source, verdictOver(counts),
          fmt::format("{}: {}", keysText(sweep.keys), detail)};
}

}  // namespace

std::vector<ClaimRecord> judgeClaims(const std::vector<ClaimSpec>& claims,
                                     const StudyRecord& study) {
  std::vector<ClaimRecord> records;
  records.reserve(claims.size());
  for (const ClaimSpec& claim : claims) {
    records.push_back(judge(claim, study));
    records.back().methods = methodsOf(claim);
  }
  return records;
}

std::vector<ClaimRecord> judgeSweepClaims(const std::vector<ClaimSpec>& claims,
                                          const SweepRecord& sweep) {
  std::vector<ClaimRecord> records;
  records.reserve(claims.size());
  for (std::size_t i = 0; i < claims.size(); ++i) {
    records.push_back(judgeOverSteps(claims[i], sweep, i));
    records.back().methods = methodsOf(claims[i]);
  }
  return records;
}

namespace {

/// How many times more samples the view has than the row's region: so much larger is the share of
/// samples that flip, if all of them lie in it.
double concentration(const StudyRecord& study, const ResultRecord& row) {
  const ResultRecord* all =
      findResult(study, row.method, {row.view, row.light}, wholeRegion, row.answer);
  if (all == nullptr || row.counts.samples == 0) return 1;
  return static_cast<double>(all->counts.samples) / static_cast<double>(row.counts.samples);
}

/// With its interval where the metric has one; `measured` is the record's, if it has one for this.
template <typename Record>
Estimate estimateWith(const ClaimSpec& claim, double value, double uncertainty,
                      const std::optional<Record>& measured) {
  if (!hasIntervals(claim)) return withoutInterval(value, uncertainty);
  if (!measured) return {value, std::nullopt, uncertainty};
  Estimate estimate{value, measured->interval, uncertainty};
  if constexpr (std::is_same_v<Record, DifferenceRecord>) {
    estimate.areEqual = measured->verdict == DifferenceVerdict::equal;
  }
  return estimate;
}

ClaimCase valueCase(const ClaimSpec& claim, const StudyRecord& study, const ResultRecord& row,
                    double value) {
  const auto measured = findConfidence(study, row.view, row.light, claim.method);
  return {row.view, estimateWith(claim, value, uncertaintyIn(study, row, claim.metric), measured),
          value};
}

ClaimCase differenceCase(const ClaimSpec& claim, const StudyRecord& study, const ResultRecord& row,
                         double less, double than) {
  const auto measured = differenceOf(study, row.view, row.light, claim.than, claim.less);
  return {row.view,
          estimateWith(claim, than - less, uncertaintyIn(study, row, claim.metric), measured),
          than > 0 ? std::optional(less / than) : std::nullopt};
}

/// The mean over all cases; without an interval where a view has none.
Estimate together(const ClaimSpec& claim, const StudyRecord& study,
                  const std::vector<ClaimCase>& cases, const std::set<std::string>& views) {
  if (claim.method.empty()) {
    const auto mean = differenceOverViews(study, claim.than, claim.less);
    return mean ? estimateOf(*mean) : Estimate{};
  }
  Estimate mean{meanValue(cases), meanInterval(study, claim.method, views)};
  for (const ClaimCase& one : cases) {
    mean.uncertainty += one.estimate.uncertainty / static_cast<double>(cases.size());
  }
  return mean;
}

}  // namespace

double uncertaintyIn(const StudyRecord& study, const ResultRecord& row, compare::MetricId metric) {
  const UncertaintyRecord* truth = findUncertainty(study, {row.view, row.light});
  if (metric.kind() != compare::MetricKind::rate) {
    return metricUncertainty(truth == nullptr ? UncertaintyRecord{} : *truth, metric);
  }
  const double flips = truth == nullptr ? study.truth.uncertainty : truth->flipRate;
  return flips * concentration(study, row);
}

ClaimCases casesOf(const ClaimSpec& claim, const StudyRecord& study) {
  const bool ofTwo = claim.method.empty();
  ClaimCases cases;
  for (const ResultRecord& row : study.results) {
    if (row.method != (ofTwo ? claim.less : claim.method) || row.region != claim.region ||
        row.answer != claim.answer) {
      continue;
    }
    const auto value = metricOf(row, claim.metric).value;
    if (!value) {
      ++cases.undefined;
    } else if (!ofTwo) {
      cases.defined.push_back(valueCase(claim, study, row, *value));
    } else if (const ResultRecord* other =
                   findResult(study, claim.than, {row.view, row.light}, row.region, row.answer)) {
      const auto than = metricOf(*other, claim.metric).value;
      if (than) cases.defined.push_back(differenceCase(claim, study, row, *value, *than));
    }
  }
  return cases;
}

Bounds boundsOf(const ClaimSpec& claim) {
  return claim.method.empty() ? Bounds{0.0, std::nullopt} : Bounds{claim.above, claim.below};
}

Verdict judgeWithin(const Estimate& estimate, const Bounds& bounds) {
  Verdict verdict = Verdict::held;
  const auto judgeBound = [&](std::optional<double> bound, DifferenceVerdict right) {
    if (!bound || verdict == Verdict::failed) return;
    const DifferenceVerdict side = distinguish(estimate, *bound);
    if (side == right) return;
    verdict = isDistinguishable(side)                         ? Verdict::failed
              : verdict != Verdict::held                      ? verdict
              : side == DifferenceVerdict::equal              ? Verdict::equal
              : side == DifferenceVerdict::notDistinguishable ? Verdict::notDistinguishable
                                                              : Verdict::noInterval;
  };
  judgeBound(bounds.above, DifferenceVerdict::worse);
  judgeBound(bounds.below, DifferenceVerdict::better);
  return verdict;
}

ClaimSpread spreadOver(const ClaimSpec& claim, const StudyRecord& study,
                       const std::vector<ClaimCase>& cases) {
  ClaimSpread spread;
  spread.quantity = claim.method.empty() ? "ratio" : "value";
  spread.hasIntervals = hasIntervals(claim);
  spread.cases = cases.size();
  std::set<std::string> views;
  std::vector<double> quantities;
  for (const ClaimCase& one : cases) {
    const Verdict verdict = judgeWithin(one.estimate, boundsOf(claim));
    spread.held += verdict == Verdict::held ? 1 : 0;
    spread.failed += verdict == Verdict::failed ? 1 : 0;
    spread.equal += verdict == Verdict::equal ? 1 : 0;
    spread.withoutInterval += verdict == Verdict::noInterval ? 1 : 0;
    views.insert(one.view);
    if (one.quantity) quantities.push_back(*one.quantity);
  }
  spread.views = views.size();
  spread.quartiles = quartilesOf(std::move(quantities));
  if (spread.hasIntervals && cases.size() > 1) {
    spread.together = judgeWithin(together(claim, study, cases, views), boundsOf(claim));
  }
  return spread;
}

ClaimRecord notEvaluated(const ClaimSpec& claim, std::string detail) {
  return {claim.text, claim.source, Verdict::notEvaluated, std::move(detail)};
}

bool hasIntervals(const ClaimSpec& claim) {
  return claim.metric == compare::metrics::errorRate && claim.region == wholeRegion &&
         claim.answer == Answer::drawn;
}

std::string intervalNote(const ClaimSpec& claim) {
  return hasIntervals(claim)
             ? ""
             : "; no interval exists for it, judged by the truth’s uncertainty alone";
}

std::string regionText(const ClaimSpec& claim) {
  return claim.region == wholeRegion ? "" : fmt::format(" in the region {}", claim.region);
}

std::string differenceText(compare::MetricId metric, double difference) {
  return metric.kind() == compare::MetricKind::rate ? fmt::format("{:.2f} points", 100 * difference)
                                                    : fmt::format("{:.3f}", difference);
}

double meanValue(const std::vector<ClaimCase>& cases) {
  double sum = 0;
  for (const ClaimCase& one : cases) sum += one.estimate.value;
  return sum / static_cast<double>(cases.size());
}

}  // namespace gnomon::study
