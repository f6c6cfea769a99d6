#pragma once

#include <string>

namespace gnomon::report {

/// What gnuplot's terminal `tikz` draws, as a picture that stands by itself: without gnuplot's
/// version and date, with what its style file would define, and with texts that stand for
/// themselves (escapeLatex).
/// @throws InternalError for a text that holds no picture
std::string tikzPicture(const std::string& drawn);

}  // namespace gnomon::report
