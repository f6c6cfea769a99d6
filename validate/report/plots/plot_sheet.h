#pragma once

#include <string>
#include <vector>

namespace gnomon::report {

/// A colour that a plot's commands name by a variable of gnuplot's: `lc rgb ink`.
struct PlotColour {
  std::string variable;
  std::string onWhite;  ///< "#1a1d21"
  bool operator==(const PlotColour&) const = default;
};

/// Those of axes and bands, which all plots have: `ink`, `axis`, `grid` and `band`.
const std::vector<PlotColour>& frameColours();

/// A plot, before it is drawn in one of the formats.
struct PlotSheet {
  std::string name;  ///< of its files
  std::string title;
  std::string about;                     ///< what it shows, for whoever cannot see it
  int width = 1000;                      ///< of the SVG, pixels; on paper 144 of them are an inch
  int height = 560;                      ///< likewise
  std::string commands;                  ///< gnuplot's, without the terminal
  std::string section = "plots";         ///< of the page that shows it
  std::vector<PlotColour> colours = {};  ///< of its methods
};

/// The plot as an SVG document, by a gnuplot of its own: the last colour of one SVG reaches into
/// the next that the same process draws. Same sheet, same bytes.
/// @throws InternalError as runGnuplot
std::string svgOf(const PlotSheet& sheet);

/// Plots as PDFs of one page, for a paper: 1000 pixels are 6.94 inches, text has 7 points. Same
/// sheet, same bytes, whatever is drawn beside it.
/// @throws InternalError as runGnuplot
std::vector<std::string> pdfsOf(const std::vector<PlotSheet>& sheets);

}  // namespace gnomon::report
