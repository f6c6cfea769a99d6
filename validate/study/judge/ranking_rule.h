#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon {

/// What a method brings to a ranking.
struct RankingEntry {
  std::optional<double> error;  ///< mean over the cases in which it has an error rate
  std::size_t cases = 0;        ///< how many those are
};

/// A method's place in a ranking.
struct RankingPlace {
  std::size_t entry = 0;            ///< index of the method
  std::optional<std::size_t> rank;  ///< 1 is best
};

/// The one rule of all ranked tables (of a study, and over the studies of a run; page, terminal,
/// LaTeX, CSV and JSON). A case is one view under one light. Means over different cases cannot be
/// compared, so a method has a rank only if it has an error rate in *every* case in which some
/// method has one. Ranked methods come first, from the lowest mean error to the highest; equal ones
/// keep their order. The others follow without a rank, those with more cases first, else in their
/// order: what their mean may be compared with is that of rank 1 over the same cases.
/// @param cases  in which some method has an error rate
std::vector<RankingPlace> rankByError(const std::vector<RankingEntry>& entries, std::size_t cases);

}  // namespace gnomon
