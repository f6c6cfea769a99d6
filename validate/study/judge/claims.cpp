#include "study/judge/claims.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <array>

#include "study/judge/claim_cases.h"
#include "study/judge/gains.h"

namespace gnomon::study {
namespace {

Verdict verdictOver(const ClaimSpread& spread) {
  if (spread.failed > 0) return Verdict::failed;
  if (spread.together) return *spread.together;
  return spread.held == spread.cases ? Verdict::held : Verdict::notDistinguishable;
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
                       claim.metric, claim.less, claim.than, regionText(claim), spreadText(spread),
                       differenceText(claim.metric, meanValue(cases.defined)), intervalNote(claim));
  }
  const std::string left =
      cases.undefined == 0 ? "" : fmt::format(", not defined in {} more", cases.undefined);
  return fmt::format("{} of “{}”{} {}: {}{}{}", claim.metric, claim.method, regionText(claim),
                     boundsText(claim), spreadText(spread), left, intervalNote(claim));
}

ClaimRecord judge(const ClaimSpec& claim, std::span<const StudyRecord> run, std::size_t own) {
  if (claim.gainGrows) return notEvaluated(claim, "judged over the values of the sweep");
  const ClaimCases cases = casesOf(claim, run[own]);
  if (cases.defined.empty()) {
    const std::string methods = claim.method.empty()
                                    ? fmt::format("“{}” and “{}”", claim.less, claim.than)
                                    : fmt::format("“{}”", claim.method);
    return notEvaluated(claim, fmt::format("{} is not defined for {}", claim.metric, methods));
  }
  if (!claim.gainExceeds.empty()) return judgeGain(claim, run[own], run);
  const ClaimSpread spread = spreadOver(claim, run[own], cases.defined);
  return {claim.text, claim.source, verdictOver(spread), detailOf(claim, cases, spread), spread};
}

std::vector<std::string> methodsOf(const ClaimSpec& claim) {
  if (!claim.method.empty()) return {claim.method};
  return {claim.less, claim.than};
}

/// A claim that each step has judged for itself.
ClaimRecord judgeOverSteps(const ClaimSpec& claim, const SweepRecord& sweep, std::size_t index) {
  std::array<std::vector<std::size_t>, 4> cases;  // a verdict
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const Verdict verdict = sweep.steps[i].claims.at(index).verdict;
    cases.at(static_cast<std::size_t>(verdict)).push_back(i);
  }
  const auto at = [&](Verdict verdict) { return cases.at(static_cast<std::size_t>(verdict)); };
  std::string detail;
  const auto tell = [&](const char* name, Verdict verdict) {
    if (at(verdict).empty()) return;
    detail +=
        fmt::format("{}{} at {}", detail.empty() ? "" : "; ", name, sweep.casesText(at(verdict)));
  };
  tell("held", Verdict::held);
  tell("failed", Verdict::failed);
  tell("not distinguishable", Verdict::notDistinguishable);
  tell("not evaluated", Verdict::notEvaluated);
  const Verdict verdict = !at(Verdict::failed).empty()                     ? Verdict::failed
                          : at(Verdict::held).size() == sweep.steps.size() ? Verdict::held
                          : !at(Verdict::notDistinguishable).empty() ? Verdict::notDistinguishable
                                                                     : Verdict::notEvaluated;
  return {claim.text, claim.source, verdict, fmt::format("{}: {}", keysText(sweep.keys), detail)};
}

}  // namespace

std::vector<ClaimRecord> judgeClaims(const std::vector<ClaimSpec>& claims,
                                     std::span<const StudyRecord> run, std::size_t own) {
  std::vector<ClaimRecord> records;
  records.reserve(claims.size());
  for (const ClaimSpec& claim : claims) {
    records.push_back(judge(claim, run, own));
    records.back().methods = methodsOf(claim);
  }
  return records;
}

std::vector<ClaimRecord> judgeSweepClaims(const std::vector<ClaimSpec>& claims,
                                          const SweepRecord& sweep) {
  std::vector<ClaimRecord> records;
  records.reserve(claims.size());
  for (std::size_t i = 0; i < claims.size(); ++i) {
    records.push_back(claims[i].gainGrows ? judgeGrowth(claims[i], sweep)
                                          : judgeOverSteps(claims[i], sweep, i));
    records.back().methods = methodsOf(claims[i]);
  }
  return records;
}

}  // namespace gnomon::study
