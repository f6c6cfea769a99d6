#pragma once

#include <optional>
#include <span>

namespace gnomon::compare {

/// Kendall's τ-b of two rankings of the same things, -1 (opposite) to 1 (the same): of all pairs,
/// those in the same order less those in the opposite order, over √((n - t₁)(n - t₂)), where n is
/// the number of pairs and t₁, t₂ that of the pairs that are tied in one ranking and the other.
/// @param first, second  a value each: ranks, or what they follow from
/// @returns none where all are tied in one of them
/// @throws InternalError where the numbers of values differ
std::optional<double> kendallTau(std::span<const double> first, std::span<const double> second);

}  // namespace gnomon::compare
