#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include "report/plots/gnuplot.h"
#include "report/text/text_width.h"

namespace gnomon::report {

// What the plots share.

/// Colours of what is no method, as lights: those of Okabe and Ito that are readable as lines on
/// white. The common colour vision deficiencies keep them apart. Methods have MethodStyles.
constexpr std::array<const char*, 7> plotColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                    "#56B4E9", "#E69F00", "#000000"};
/// gnuplot's numbers of point shapes, one a colour.
constexpr std::array<int, 7> plotPoints = {7, 5, 9, 13, 11, 6, 4};

/// The style of a plot's m-th line with its points.
inline std::string plotLine(std::size_t m) {
  return "lc rgb '" + std::string(plotColours.at(m % plotColours.size())) + "' pt " +
         std::to_string(plotPoints.at(m % plotPoints.size())) + " ps 0.7 lw 2 dt " +
         std::to_string(1 + m / plotColours.size());
}

/// Axes, tics and grid as all plots have them.
/// @param sides  gnuplot's sum of the sides that have an axis: 1 bottom, 2 left
/// @param grid   "xtics " or "ytics " for lines of that axis alone
inline std::string plotFrame(int sides = 3, const std::string& grid = "") {
  return "set border " + std::to_string(sides) +
         " lc rgb axis\n"
         "set tics nomirror out textcolor rgb ink\n"
         "set grid " +
         grid + "lc rgb grid lw 1 dt 1\n";
}

/// Rows under a name that the plot command takes: "$m0".
inline std::string plotData(const std::string& name, const std::string& rows) {
  return name + " << EOD\n" + rows + "EOD\n";
}

/// The indices of numbers from the smallest to the largest.
inline std::vector<std::size_t> risingOrder(const std::vector<double>& numbers) {
  std::vector<std::size_t> order(numbers.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return numbers[i]; });
  return order;
}

/// How the bars of its intervals are drawn, of columns x, low and high.
/// @param cap  half the width of their ends, of that of the axis
inline std::string plotBars(std::size_t m, const char* cap) {
  return "using 1:2:(0):($3-$2) with vectors heads size graph " + std::string(cap) +
         ",90 lc rgb '" + std::string(plotColours.at(m % plotColours.size())) +
         "' lw 1 dt 1 notitle";
}

/// The most characters of a label that a legend shows.
constexpr std::size_t longestLegend = 40;

/// A label of a legend, shortened where it is too long, quoted for gnuplot.
inline std::string plotLegend(const std::string& label) {
  return gnuplotText(displayWidth(label) > longestLegend ? fitLeft(label, longestLegend) : label);
}

}  // namespace gnomon::report
