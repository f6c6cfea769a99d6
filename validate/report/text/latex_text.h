#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::report {

/// Text that stands for itself in LaTeX: its special characters are escaped, the signs that reports
/// use beyond ASCII become commands, control characters spaces, what is no UTF-8 '?'. A [ or * at
/// the beginning is put into braces, or the end of a row before it would read it. Other UTF-8 stays
/// as it is, as LaTeX has read it since 2018.
std::string escapeLatex(std::string_view text);

/// How wide a text is set, in units of its font's size: an upper bound for words and numbers in
/// Computer Modern and Times, from 9 points on.
double latexWidth(std::string_view text);

/// The text, cut where it is wider than that (latexWidth); then it ends in "…".
std::string cutText(const std::string& text, double width);

/// The parts between which a text may be broken into lines: each ends behind a space, a hyphen, a
/// slash, an underscore, a comma, a colon or the last of several of them.
std::vector<std::string> breakableParts(std::string_view text);

}  // namespace gnomon::report
