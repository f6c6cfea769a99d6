#pragma once

#include <string>
#include <vector>

#include "report/tables/table.h"

namespace gnomon::report {

/// Where a plot is drawn.
enum class PlotPlace {
  paper,  ///< on white, its legend inside: a PDF, or an SVG by itself
  page,   ///< inside a page, whose colours it takes and which has the legend
  phone,  ///< likewise, on a narrow screen
};

/// A colour that a plot's commands name by a variable of gnuplot's: `lc rgb ink`. A page has the
/// CSS property `--plot-ink` in its place, one on white and one on dark.
struct PlotColour {
  std::string variable;
  std::string onWhite;  ///< "#1a1d21"
  std::string onDark;
  std::string family = {};  ///< of a method's: the one whose colour it has while it is highlighted
  bool operator==(const PlotColour&) const = default;
};

/// Those that all plots have: `ink`, `axis`, `grid`, `band`, and `light0` to `light6` for curves of
/// what is no method.
const std::vector<PlotColour>& frameColours();

/// An entry of the legend that a page shows under a plot.
struct LegendItem {
  std::string text = {};
  std::string variable = {};  ///< of its colour
  int point = 0;              ///< gnuplot's number of its shape; 0 for none
  int dash = 0;               ///< of its line; 0 for none
  bool isMethod = false;      ///< a reader can highlight it
  bool isHighlighted = true;
};

/// A plot, before it is drawn in one of the formats.
struct PlotSheet {
  std::string name = {};  ///< of its files
  std::string title = {};
  std::string about = {};                ///< what it shows, for whoever cannot see it
  int width = 1000;                      ///< of the SVG, pixels; on paper 144 of them are an inch
  int height = 560;                      ///< likewise
  std::string commands = {};             ///< gnuplot's, without the terminal
  std::string section = "plots";         ///< of the page that shows it
  std::vector<PlotColour> colours = {};  ///< of its methods
  PlotPlace place = PlotPlace::paper;
  /// What a reader who points at a value is told. The commands draw an invisible label at each,
  /// `valuePoints`, whose text is the index into this list.
  std::vector<std::string> values = {};
  std::vector<LegendItem> legend = {};  ///< for a page
  Table table = {};                     ///< the same values
  /// Its colours are shades that mean something together, which a dark page inverts as a whole.
  bool isShaded = false;
  /// Whether its first panel is a figure of a paper: what it shows is whole without the others.
  bool isForPaper = true;
  std::string columnCommands = {};  ///< what a figure as wide as a paper's column sets instead
};

/// Commands that give the colours of the sheet's commands their values at its place.
std::string colourSettings(const PlotSheet& sheet);

/// Plots as SVG documents. Same sheet, same bytes, whatever is drawn beside it.
/// @throws InternalError as drawByGnuplot
std::vector<std::string> svgsOf(const std::vector<PlotSheet>& sheets);

/// One of them.
std::string svgOf(const PlotSheet& sheet);

/// Plots as PDFs of one page, for a paper: 1000 pixels are 6.94 inches, text has 7 points. Same
/// sheet, same bytes, whatever is drawn beside it.
/// @throws InternalError as drawByGnuplot
std::vector<std::string> pdfsOf(const std::vector<PlotSheet>& sheets);

/// The colour that gnuplot is given for a page: #01 and the index in two bytes, of `frameColours`
/// and then of the sheet's own. `pageSvg` puts the page's colour of that index in its place.
std::string indexColour(std::size_t index);

/// What gnuplot's terminal pdfcairo draws for each of several scripts (drawByGnuplot), without its
/// date.
/// @throws InternalError as drawByGnuplot
std::vector<std::string> undatedPdfs(const std::vector<std::string>& scripts);

}  // namespace gnomon::report
