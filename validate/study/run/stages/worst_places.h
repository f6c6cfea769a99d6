#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "common/mask.h"
#include "common/visibility.h"
#include "study/record/record.h"
#include "study/run/stages/run_writer.h"

namespace gnomon::study {

/// Of the squares: their sides, in samples, and their number at most.
constexpr int worstPlaceSide = 64;
constexpr std::size_t mostWorstPlaces = 3;

/// The colour of a sample in a picture, RGB, by its place in the map.
using SampleColour = std::function<std::array<std::uint8_t, 3>(std::size_t)>;

/// How far an answer is off the truth at each sample: 0 or 1, and 0 where there is no sample.
std::vector<float> sampleErrors(const Mask& answer, const Mask& truth);
/// The same under a light with a disc: |ΔV|.
std::vector<float> sampleErrors(const Visibility& answer, const Visibility& truth);

/// The squares where an answer errs most, none that overlap: see compare::worstWindows.
/// @param errors      one a sample of a view that is so wide and high
/// @param own, right  what pictures of the answer and of the truth show there
std::vector<WorstPlace> worstPlaces(const std::vector<float>& errors, int width, int height,
                                    const SampleColour& own, const SampleColour& right,
                                    const RunWriter& writer);

}  // namespace gnomon::study
