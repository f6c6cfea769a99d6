#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "study/record/sweep_record.h"

namespace gnomon::report {

/// Cases of a sweep along one axis, in increasing order: what one plot shows.
struct SweepSlice {
  std::string suffix;  ///< of the plot's file: "", or "_2" where there are several slices
  std::string title;   ///< what its cases share: "bake.bits = 8"; empty for all cases
  std::string axis;    ///< label
  std::vector<std::size_t> cases;
  std::vector<double> positions;  ///< on the axis, one a case
  /// Of values that are no numbers the labels of the positions 0, 1, …; else empty.
  std::vector<std::string> categories = {};
};

/// The most plots of one kind of a sweep.
constexpr std::size_t mostSlices = 8;

/// How a sweep is cut into plots. Of one dimension it is one slice. Of two the dimension with more
/// values is the axis, and each value of the other, of at most mostSlices, has its own slice. None
/// otherwise.
std::vector<SweepSlice> slicesOf(const study::SweepRecord& sweep);

/// A sweep over a grid of two dimensions, each with more than mostSlices values: neither is drawn.
struct SweepGrid {
  std::string acrossAxis, upAxis;
  std::vector<std::string> across, up;  ///< the values in increasing order, three digits
  /// The case of each place, row by row from the bottom.
  std::vector<std::size_t> cases;
};
bool isGrid(const study::SweepRecord& sweep);
/// @param sweep  one for which isGrid
SweepGrid gridOf(const study::SweepRecord& sweep);

/// The i-th place of a slice's axis, "16"; and as a sentence has it, "azimuths 16".
std::string placeText(const SweepSlice& slice, std::size_t i);
std::string valueText(const SweepSlice& slice, std::size_t i);

/// The slice's axis across a plot: its labels where its values are no numbers, logarithmic where
/// each of four or more is the same multiple of the one before, to a hundredth. It ends at the
/// first and the last value, but for the plot's own offsets.
std::string axisCommands(const SweepSlice& slice);

/// "set xtics (…)" for labels at 0, 1, …, of many only some.
std::string categoryTics(const char* axis, const std::vector<std::string>& labels);

}  // namespace gnomon::report
