#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/mask.h"
#include "compare/counts.h"

namespace gnomon::compare {

/// The bin of a sample that has none.
constexpr std::uint8_t noBin = 255;

/// @throws InternalError for `noBin` edges or more, or edges that do not rise
void requireEdges(std::span<const double> edges);

/// The bin that holds a value: n edges, in rising order, make n + 1 bins, of which each holds its
/// lower edge but not its upper one. Bin 0 is what lies below all edges, bin n what lies at the
/// last or beyond, infinity too.
/// @param edges  as requireEdges
/// @returns 0 to n, or `noBin` for NaN: a sample without that value
std::uint8_t binOf(double value, std::span<const double> edges);
/// The counts of each bin: countSamples of the samples whose bin it is. They add up to those of all
/// samples that have a bin.
/// @param bins      one a sample, each below `binCount` or `noBin`
/// @param weights   one a sample, or empty for 1 each
/// @throws InputError if sizes differ, or a sample that has a bin is in one mask alone;
///   InternalError for a bin out of range
std::vector<Counts> countBins(const Mask& candidate, const Mask& truth,
                              std::span<const std::uint8_t> bins, std::size_t binCount,
                              std::span<const double> weights = {});
std::vector<Counts> countBins(const Visibility& candidate, const Visibility& truth,
                              std::span<const std::uint8_t> bins, std::size_t binCount,
                              std::span<const double> weights = {});

}  // namespace gnomon::compare
