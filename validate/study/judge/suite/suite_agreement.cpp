#include "study/judge/suite/suite_agreement.h"

#include <algorithm>

#include "common/lists.h"
#include "compare/scenes/comparisons.h"

namespace gnomon::study {
namespace {

std::optional<double> meanIn(const SuiteRanking& ranking, const std::string& label) {
  for (const SuiteRanking::Method& method : ranking.methods) {
    if (method.label == label) return method.mean;
  }
  return std::nullopt;
}

bool isToldApart(const SuiteRanking& ranking, const std::string& a, const std::string& b) {
  return contains(ranking.distinguishable, std::pair(a, b)) ||
         contains(ranking.distinguishable, std::pair(b, a));
}

}  // namespace

SuiteRanking rankingOf(const SuiteStatistics& statistics) {
  SuiteRanking ranking;
  for (const SuiteMethod& method : statistics.methods) {
    if (method.rank) ranking.methods.push_back({method.label, method.spread.mean});
  }
  for (const SuitePair& pair : statistics.pairs) {
    if (pair.verdict == DifferenceVerdict::better) {
      ranking.distinguishable.emplace_back(pair.first, pair.second);
    } else if (pair.verdict == DifferenceVerdict::worse) {
      ranking.distinguishable.emplace_back(pair.second, pair.first);
    }
  }
  return ranking;
}

SuiteAgreement agreementOf(const SuiteRanking& first, const SuiteRanking& second) {
  std::vector<SuiteRanking::Method> shared;
  std::vector<double> means, others;
  for (const SuiteRanking::Method& method : first.methods) {
    const auto other = meanIn(second, method.label);
    if (!other) continue;
    shared.push_back(method);
    means.push_back(method.mean);
    others.push_back(*other);
  }
  SuiteAgreement agreement;
  agreement.methods = shared.size();
  agreement.tau = compare::kendallTau(means, others);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    for (std::size_t j = i + 1; j < shared.size(); ++j) {
      ++agreement.pairs;
      if (!((means[i] - means[j]) * (others[i] - others[j]) < 0)) continue;
      ++agreement.swapped;
      const std::string& a = shared[i].label;
      const std::string& b = shared[j].label;
      if (isToldApart(first, a, b) || isToldApart(second, a, b)) {
        agreement.contradictions.emplace_back(a, b);
      }
    }
  }
  return agreement;
}

}  // namespace gnomon::study
