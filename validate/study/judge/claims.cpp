#include "study/judge/claims.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <array>
#include <numeric>

#include "study/judge/claim_cases.h"

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

}  // namespace gnomon::study
