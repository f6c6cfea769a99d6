#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/mask.h"
#include "common/visibility.h"
#include "compare/worst_windows.h"
#include "study/record/record.h"
#include "study/run/stages/run_writer.h"

namespace gnomon::study {

/// Of the squares: their sides, in samples, and their number at most.
constexpr int worstPlaceSide = 64;
constexpr std::size_t mostWorstPlaces = 3;

/// The colour of a sample in a picture, RGB, by its place in the map.
using SampleColour = std::function<std::array<std::uint8_t, 3>(std::size_t)>;

/// How far an answer is off the truth at each sample: 0 or 1, and 0 where there is no sample.
std::vector<std::uint8_t> sampleErrors(const Mask& answer, const Mask& truth);
/// The same under a light with a disc: |ΔV|.
std::vector<float> sampleErrors(const Visibility& answer, const Visibility& truth);

/// The squares where an answer errs most, none that overlap: see compare::worstWindows.
template <typename Map>
std::vector<compare::Window> worstSquares(const Map& answer, const Map& truth) {
  const auto errors = sampleErrors(answer, truth);
  return compare::worstWindows(std::span(errors), answer.width, answer.height, worstPlaceSide,
                               mostWorstPlaces);
}

/// The same squares as a page shows them.
/// @param width       of the view
/// @param own, right  what pictures of the answer and of the truth show there
std::vector<WorstPlace> worstPlaces(std::span<const compare::Window> squares, int width,
                                    const SampleColour& own, const SampleColour& right,
                                    const RunWriter& writer);

}  // namespace gnomon::study
