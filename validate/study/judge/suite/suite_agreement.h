#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "study/judge/suite/suite_statistics.h"

namespace gnomon::study {

/// How the ranking over one set of scenes agrees with that over another.

struct SuiteRanking {
  struct Method {
    std::string label;
    double mean = 0;
  };
  std::vector<Method> methods;  ///< those with a rank
  /// Of two labels each, the better first: those that are distinguishable.
  std::vector<std::pair<std::string, std::string>> distinguishable;
};

SuiteRanking rankingOf(const SuiteStatistics& statistics);

struct SuiteAgreement {
  std::size_t methods = 0;    ///< with a rank in both
  std::optional<double> tau;  ///< Kendall's τ-b of their means; none for fewer than two methods
  std::size_t pairs = 0;      ///< of these methods
  std::size_t swapped = 0;    ///< pairs in another order there
  /// Swapped pairs that are distinguishable in at least one of the rankings, in the first one's
  /// order. None are expected.
  std::vector<std::pair<std::string, std::string>> contradictions;
};

SuiteAgreement agreementOf(const SuiteRanking& first, const SuiteRanking& second);

}  // namespace gnomon::study
