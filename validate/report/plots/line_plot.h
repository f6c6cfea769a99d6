#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/confidence_interval.h"
#include "report/plots/drawn_plots.h"
#include "report/plots/plot_style.h"
#include "study/judge/study_means.h"
#include "study/judge/suite/suite_statistics.h"

namespace gnomon::report {

/// A point of a curve; a gap where it has no y, a bar where it has an interval.
struct PlotPoint {
  double x = 0;
  std::optional<double> y;
  std::optional<compare::Interval> bar = {};  ///< in the units of y
};

struct PlotCurve {
  std::string label;  ///< in the legend
  std::string style;  ///< gnuplot's clause
  std::vector<PlotPoint> points;
  std::string with = "linespoints";  ///< gnuplot's word for what is drawn: also "points", "steps"
};

/// Curves of methods over two axes: every plot but the matrix of wins.
struct LinePlot {
  std::string name = {}, title = {}, about = {};
  std::string section = "plots";
  std::string xLabel = {}, yLabel = {};
  std::string axes = {};  ///< gnuplot's settings: scales, ranges, tics
  std::vector<PlotCurve> curves = {};
  /// How uncertain the truth is, a grey area below these points.
  std::vector<PlotPoint> band = {};
};

/// As a report shows it, its legend at the right.
PlotSheet sheetOf(const LinePlot& plot);
std::vector<PlotSheet> sheetsOf(const std::vector<LinePlot>& plots);

/// The commands of a figure for a paper: its legend below, all text in one size.
/// @param fontSize  points
/// @param columns   of the legend
std::string paperCommands(const LinePlot& plot, double fontSize, std::size_t columns);

/// The curve's style of each method of a report, by its label.
class MethodStyles {
 public:
  /// @param study  of a run or a sweep
  explicit MethodStyles(const study::StudyMeans& study);
  explicit MethodStyles(const study::SuiteStatistics& statistics);
  /// @throws InternalError for a label that is no method's
  [[nodiscard]] std::string of(const std::string& label) const;

 private:
  std::vector<std::pair<std::string, std::string>> styles_;
};

/// A label as a legend has it, shortened where it is too long.
std::string shortLegend(const std::string& label);

/// Ends of a bin of an axis.
using BinEnds = std::pair<std::optional<double>, std::optional<double>>;

/// Where bins stand on an axis: each in its middle, on a logarithmic axis if their edges grow by
/// one factor. A bin without an end is as wide as its neighbour.
struct BinAxis {
  std::vector<double> middles;
  double left = 0, right = 1;
  std::string commands;  ///< gnuplot's, of scale and range
};
/// @param ends  rising, at least one; the bin without a lower end first
BinAxis binAxis(const std::vector<BinEnds>& ends);

/// "elevation of the light, degrees", or the name of an axis of bins that is not known here.
std::string axisTitle(std::string_view axis);

/// Whether each of four or more places is the same multiple of the one before, to a hundredth: they
/// stand on a logarithmic axis.
bool isGeometric(const std::vector<double>& places);

}  // namespace gnomon::report
