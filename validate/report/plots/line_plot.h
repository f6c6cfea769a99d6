#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/confidence_interval.h"
#include "render/method.h"
#include "report/plots/gnuplot.h"
#include "study/judge/ranking.h"
#include "study/judge/suite/suite_statistics.h"

namespace gnomon::report {

// The colours and symbols of all plots. A method looks the same in every plot of every report: its
// colour is that of its family, its symbol and dashes follow from its file, its name and its label
// alone.

/// A colour on a white page and on a dark one.
struct PlotColour {
  std::string_view name;
  std::string_view onWhite, onDark;
};

/// The families' colours, as render::methodFamilies has them; "own" of files that name none. Any
/// two differ by 20 or more in CIELAB to eyes with full colour vision and to those with protanopia,
/// deuteranopia or tritanopia (Machado, Oliveira & Fernandes 2009, severity 1), and stand out from
/// their page by a contrast of 3 or more (WCAG 2).
constexpr std::array<PlotColour, 8> familyColours = {{
    {"control", "#1a1d21", "#e8eaed"},
    {"flat", "#c57500", "#c16309"},
    {"curvature", "#01684d", "#03ca87"},
    {"march", "#2a80ff", "#187cf5"},
    {"displaced", "#611263", "#ff89e8"},
    {"engine", "#ad8b58", "#d9bb05"},
    {"ours", "#840000", "#c9143e"},
    {"own", "#0e249b", "#884ea3"},
}};

/// Texts, axes, grids and the band of the truth's uncertainty, and the page itself. Texts have the
/// colour of the family "control".
constexpr std::array<PlotColour, 4> frameColours = {{{"axis", "#5b626b", "#a0a8b2"},
                                                     {"grid", "#dde1e6", "#31363d"},
                                                     {"band", "#c8c8c8", "#454b53"},
                                                     {"page", "#ffffff", "#14171b"}}};
constexpr std::string_view inkColour = familyColours[0].onWhite;
constexpr std::string_view axisColour = frameColours[0].onWhite;
constexpr std::string_view gridColour = frameColours[1].onWhite;
constexpr std::string_view bandColour = frameColours[2].onWhite;

/// CSS for gnuplot's SVG: on dark screens its colours on white become those on dark.
const std::string& darkStyle();

/// How a method is drawn.
struct MethodStyle {
  std::string family;  ///< one of familyColours
  int point = 7;       ///< gnuplot's number of a point's shape
  int dash = 1;        ///< gnuplot's number of a line's dashes; 1 is solid
  bool operator==(const MethodStyle&) const = default;
};

/// A method under its own name has its file's symbol, filled, and a solid line. A variant, which is
/// any other label, has an outlined symbol and dashes that follow from its label. Where a file
/// names no symbol, that follows from the method's name.
/// @param name   the method's own
/// @param label  of its entry in the study
MethodStyle methodStyle(const std::string& name, const std::string& label,
                        const render::MethodMark& mark);

/// gnuplot's clause of lines and points in a style.
std::string styleClause(const MethodStyle& style);

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

/// The curve's style of each method of a report, by its label: as methodStyle has it; of methods
/// that one plot shows and that have a colour in common, the later takes a symbol and dashes that
/// none before it has.
class MethodStyles {
 public:
  /// @param study  of a run or a sweep
  /// @param shown  labels of the methods that one plot shows, in the order of its legend
  MethodStyles(const study::StudyMeans& study, const std::vector<std::string>& shown);
  MethodStyles(const study::SuiteStatistics& statistics, const std::vector<std::string>& shown);
  /// @throws InternalError for a label that is no method's
  [[nodiscard]] std::string of(const std::string& label) const;

 private:
  void setApart(const std::vector<std::string>& shown);

  std::vector<std::pair<std::string, MethodStyle>> styles_;
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

/// Bump mapping alone: the method that every other must beat.
constexpr std::string_view controlMethod = "unshadowed";

/// The label of the method of that name; of several the one without a label of its own.
std::optional<std::string> labelOf(std::span<const study::MethodMeans> methods,
                                   std::string_view name);

/// The label of the best method: the first of a ranking that has a rank and is not the control.
std::optional<std::string> bestMethod(const std::vector<study::RankedMethod>& ranked);

/// The first method that a claim is about and that is neither `costReference` nor the control.
std::optional<std::string> claimedMethod(std::span<const study::MethodMeans> methods,
                                         std::span<const study::ClaimRecord> claims);

/// The most methods that a plot shows.
constexpr std::size_t mostPlotted = 8;

/// The methods that plots show and of which a page shows the worst places, in the order of the
/// ranking: the flat horizon map (`costReference`), the method that the first claim is about, and
/// the first of the ranking, `mostPlotted` in all; of a method with several entries the best one,
/// and more where there is room.
/// @param study   of a run or a sweep
/// @param chosen  labels that are shown instead, in their order, where the study has any of them
std::vector<std::string> plottedMethods(const study::StudyMeans& study,
                                        const std::vector<std::string>& chosen = {});

/// Likewise of a suite, whose ranking is over its scenes and which claims nothing.
std::vector<std::string> plottedMethods(const study::SuiteStatistics& statistics,
                                        const std::vector<std::string>& chosen = {});

}  // namespace gnomon::report
