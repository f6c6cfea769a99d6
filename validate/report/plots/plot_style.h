#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include "report/plots/gnuplot.h"
#include "report/plots/plot_sheet.h"
#include "report/text/text_width.h"

namespace gnomon::report {

// What the plots share.

/// gnuplot's numbers of point shapes, one a light's colour.
constexpr std::array<int, 7> lightPoints = {7, 5, 9, 13, 11, 6, 4};

/// The colour of a curve that is no method's, a variable of `frameColours`.
inline std::string lightColour(std::size_t l) {
  return "light" + std::to_string(l % lightPoints.size());
}
/// The style of its line with points.
inline std::string lightLine(std::size_t l) {
  return "lc rgb " + lightColour(l) + " pt " +
         std::to_string(lightPoints.at(l % lightPoints.size())) + " ps 0.7 lw 2 dt " +
         std::to_string(1 + l / lightPoints.size());
}

/// Axes, tics and grid as all plots have them.
/// @param sides  gnuplot's sum of the sides that have an axis: 1 bottom, 2 left
/// @param grid   "xtics " or "ytics " for lines of that axis alone
inline std::string plotFrame(int sides = 3, const std::string& grid = "") {
  return "set border " + std::to_string(sides) +
         " lc rgb axis\n"
         "set tics nomirror out textcolor rgb ink\n"
         "set xlabel textcolor rgb ink\nset ylabel textcolor rgb ink\n"
         "set x2label textcolor rgb ink\nset title textcolor rgb ink\n"
         "set key textcolor rgb ink\n"
         "set grid " +
         grid + "lc rgb grid lw 1 dt 1\n";
}

/// Where the axes of a plot end.
struct PlotMargins {
  int left, right, top, bottom;  ///< pixels from the plot's edges
};

/// The margins of a plot of a size.
std::string plotMargins(const PlotMargins& margins, int width, int height);

/// Rows under a name that the plot command takes: "$m0".
inline std::string plotData(const std::string& name, const std::string& rows) {
  return name + " << EOD\n" + rows + "EOD\n";
}

/// Whether each of four or more places is the same multiple of the one before, to a hundredth: they
/// stand on a logarithmic axis.
bool isGeometric(const std::vector<double>& places);

/// The indices of numbers from the smallest to the largest.
inline std::vector<std::size_t> risingOrder(const std::vector<double>& numbers) {
  std::vector<std::size_t> order(numbers.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return numbers[i]; });
  return order;
}

/// How bars of intervals are drawn in a colour, of columns x, low and high.
/// @param cap  half the width of their ends, of that of the axis
inline std::string plotBars(const std::string& variable, const char* cap) {
  return "using 1:2:(0):($3-$2) with vectors heads size graph " + std::string(cap) + ",90 lc rgb " +
         variable + " lw 1 dt 1 notitle";
}

/// The truth's uncertainty from one end of the axis to the other, of rows of x and y.
/// @param title  "notitle", or a title
std::string plotBand(const std::string& data, bool hasTitle);
/// The same on an axis that has no 0, below a value: a setting, and its entry of the legend.
std::string plotBandBelow(double value);
std::string plotBandEntry();
constexpr const char* bandLegend = "uncertainty of the truth";

/// The entry of the band in the legend of a page.
LegendItem bandItem();

/// The most characters of a label that a legend shows.
constexpr std::size_t longestLegend = 40;

/// A label of a legend, shortened where it is too long.
inline std::string shortLegend(const std::string& label) {
  return displayWidth(label) > longestLegend ? fitLeft(label, longestLegend) : label;
}
/// Likewise, quoted for gnuplot.
inline std::string plotLegend(const std::string& label) {
  return gnuplotText(shortLegend(label));
}

/// The values of a plot that a reader can point at.
class ValuePoints {
 public:
  /// @param name  of their data, "$values"; one for each panel
  explicit ValuePoints(std::string name) : name_(std::move(name)) {}

  /// Adds a value of the sheet at a place of the axes. Values of one curve follow one another.
  void add(PlotSheet& sheet, double x, double y, std::string text);
  /// Ends a curve.
  void endCurve();
  /// The rows, before the plot command; nothing on paper or without a value.
  [[nodiscard]] std::string data(const PlotSheet& sheet) const;
  /// The part of the plot command, ", $values …"; likewise.
  [[nodiscard]] std::string plot(const PlotSheet& sheet) const;

 private:
  [[nodiscard]] bool areDrawn(const PlotSheet& sheet) const;

  std::string name_;
  std::vector<std::string> curves_ = {""};
};

}  // namespace gnomon::report
