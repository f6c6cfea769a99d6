#pragma once

#include <string>
#include <vector>

namespace gnomon::cache {
class Cache;
}

namespace gnomon::report {

/// A plot, before it is drawn.
struct PlotSheet {
  std::string name = {};  ///< of its files
  std::string title = {};
  std::string about = {};         ///< what it shows, for whoever cannot see it
  std::string section = "plots";  ///< of the page that shows it
  int width = 1000;               ///< of the SVG, pixels; of the PDF 144 of them are an inch
  int height = 560;               ///< likewise
  std::string commands = {};      ///< gnuplot's, without the terminal
};

/// As gnuplot draws it. A page embeds the SVG as it is.
struct DrawnPlot {
  PlotSheet sheet;
  std::string svg, pdf;
};

/// Plots as SVG documents, with a style sheet that gives them the colours of a dark page where a
/// reader has asked for one. Same sheet, same bytes, whatever is drawn beside it.
/// @throws InternalError as drawByGnuplot
std::vector<std::string> svgsOf(const std::vector<PlotSheet>& sheets);

/// Plots as PDFs of one page, for a paper: 1000 pixels are 6.94 inches, text has 7 points. Same
/// sheet, same bytes, whatever is drawn beside it.
/// @throws InternalError as drawByGnuplot
std::vector<std::string> pdfsOf(const std::vector<PlotSheet>& sheets);

/// What gnuplot's terminal pdfcairo draws for each of several scripts (drawByGnuplot), without its
/// date.
/// @throws InternalError as drawByGnuplot
std::vector<std::string> undatedPdfs(const std::vector<std::string>& scripts);

/// Draws the plots of a report in both formats, several in one process of gnuplot.
/// @param cache  gives what it has and keeps what was drawn; may be null
/// @throws InternalError as drawByGnuplot
std::vector<DrawnPlot> drawPlots(std::vector<PlotSheet> sheets, cache::Cache* cache);

}  // namespace gnomon::report
