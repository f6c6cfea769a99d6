#pragma once

#include <string>

namespace gnomon {

/// What gnuplot writes for a script, given to it on its standard input, without the user's own
/// settings.
/// @throws InternalError in one line where gnuplot cannot be started or refuses the script
std::string runGnuplot(const std::string& script);

/// The version of the gnuplot that is there: "5.4.4". Asked once.
/// @throws as runGnuplot
const std::string& gnuplotVersion();

/// A text as gnuplot reads it between single quotes, where nothing is special but the quote itself:
/// that becomes ’, and control characters become spaces.
std::string gnuplotText(const std::string& text);

/// An SVG of gnuplot's as a document of its own: with the title given, and without the line that
/// names gnuplot's version, so that the same plot has the same bytes.
std::string cleanSvg(const std::string& svg, const std::string& title);

}  // namespace gnomon
