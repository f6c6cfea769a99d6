#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "report/plots/line_plot.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// The plots of a study:
///   error-by-AXIS_VIEW  error rates in the bins of an axis of samples, all lights together, with
///                       the truth's uncertainty; none of one bin alone. A method without samples
///                       in a bin has a gap there.
///   frontier            error against the memory of tables and height map, both logarithmic, a
///                       point an entry, the efficient ones of all entries joined by steps
///   frontier_time       likewise against the time of a frame
/// Of the frontiers a method has all its entries, and the style of the one that is shown.
/// @param shown  labels of the methods that are drawn, in the order of the legend (plottedMethods)
/// @throws InternalError for a number that is not finite
std::vector<LinePlot> studyPlots(const study::StudyRecord& record,
                                 const std::vector<std::string>& shown);

/// Sections of a sweep's page that have plots.
constexpr const char* sweepErrorSection = "plot";
constexpr const char* sweepCostSection = "cost";

/// The plots of a sweep:
///   sweep, sweep_2 …  a slice each (slicesOf): the mean error rate over lights and views against
///                     the swept value, with 95 % intervals, and the truth's uncertainty. A figure
///                     that is not defined leaves a gap.
///   sweep_memory      of one dimension: the mean error rate against the memory of tables and
///   height
///                     map, both logarithmic, from the lowest value to the highest. Of the methods
///                     whose memory changes with the value, if there is one.
/// @param shown  labels of the methods that are drawn, in the order of the legend (plottedMethods)
/// @throws InternalError for a number that is not finite
std::vector<LinePlot> sweepPlots(const study::SweepRecord& sweep,
                                 const std::vector<std::string>& shown);

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

/// gnuplot's commands of the slice's axis: its labels where its values are no numbers, of many only
/// some; logarithmic where
/// each of four or more is the same multiple of the one before, to a hundredth. It ends at the
/// first and the last value, but for the plot's own offsets.
std::string axisCommands(const SweepSlice& slice);

}  // namespace gnomon::report
