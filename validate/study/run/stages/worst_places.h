#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "common/visibility.h"
#include "study/record/record.h"
#include "study/run/stages/run_writer.h"

namespace gnomon::study {

/// Of the squares: their sides, in samples, and their number at most.
constexpr int worstPlaceSide = 64;
constexpr std::size_t mostWorstPlaces = 3;

/// The colour of a sample in a picture, RGB, by its place in the map.
using SampleColour = std::function<std::array<std::uint8_t, 3>(std::size_t)>;

/// The squares where an answer errs most, none that overlap: see compare::worstWindows. An error is
/// 0 or 1, under a light with a disc |ΔV|; 0 where there is no sample.
/// @param answer, truth  at the same samples
/// @param own, right     what pictures of them show there
std::vector<WorstPlace> worstPlaces(const Visibility& answer, const Visibility& truth,
                                    const SampleColour& own, const SampleColour& right,
                                    const RunWriter& writer);

}  // namespace gnomon::study
