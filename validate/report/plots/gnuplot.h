#pragma once

#include <string>
#include <vector>

namespace gnomon::report {

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
