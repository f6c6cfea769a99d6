#pragma once

#include <string>

namespace gnomon {

/// A plot, before it is drawn in one of the formats.
struct PlotSheet {
  std::string name;  ///< of its files
  std::string title;
  std::string about;     ///< what it shows, for whoever cannot see it
  int width = 1000;      ///< of the SVG, pixels; on paper 144 of them are an inch
  int height = 560;      ///< likewise
  std::string commands;  ///< gnuplot's, without the terminal
};

/// The plot as an SVG document. Same sheet, same bytes.
/// @throws InternalError as runGnuplot
std::string svgOf(const PlotSheet& sheet);

/// The plot as a PDF of one page, for a paper: 1000 pixels are 6.94 inches, text has 7 points. Same
/// sheet, same bytes.
/// @throws InternalError as runGnuplot
std::string pdfOf(const PlotSheet& sheet);

}  // namespace gnomon
