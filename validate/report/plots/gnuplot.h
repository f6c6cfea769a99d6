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

/// What gnuplot writes for a script, given to it on its standard input, without the user's own
/// settings, be they in files or in variables of the environment.
/// @throws InternalError in one line where gnuplot cannot be started or refuses the script
std::string runGnuplot(const std::string& script);

/// How a PDF keeps the objects that hold its date.
enum class PdfObjects {
  compressed,  ///< as cairo chooses: compressed from 1.18 on
  plain,       ///< as text, and its drawings too
};

/// How drawByGnuplot draws.
struct DrawingOptions {
  std::string before = {};  ///< a script that runs before each of the others, and draws nothing
  PdfObjects objects = PdfObjects::compressed;
};

/// What gnuplot draws for each of several scripts, one after the other. Its process is kept and
/// draws the next call's too: its start takes longer than most plots. From one script to the next
/// pass only redefined linetypes, and what a terminal itself remembers. Calls at the same time have
/// a process each.
/// @param scripts  set a terminal, and no output
/// @throws as runGnuplot, and where a script draws nothing
std::vector<std::string> drawByGnuplot(const std::vector<std::string>& scripts,
                                       const DrawingOptions& options = {});

/// Starts a gnuplot that tells its version, so that a missing one shows at once.
/// @throws InternalError where it cannot be started
void askGnuplotVersion();

/// The version of the gnuplot that is there: "5.4.4". Asked once; waits for the answer.
/// @throws as runGnuplot
const std::string& gnuplotVersion();

/// A text as gnuplot reads it between single quotes, where nothing is special but the quote itself:
/// that becomes ’, and the rest is `oneLine`.
std::string gnuplotText(const std::string& text);

/// An SVG of gnuplot's as a document of its own: with the title and the style sheet given, and
/// without the line that names gnuplot's version, so that the same plot has the same bytes.
/// Well-formed whatever labels hold.
std::string styledSvg(const std::string& svg, const std::string& title, const std::string& style);

}  // namespace gnomon::report
