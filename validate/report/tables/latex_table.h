#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/tables/table.h"

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

/// TeX's points in a millimetre.
constexpr double pointsOfMillimetre = 72.27 / 25.4;

/// The room that a paper gives a table.
struct TabularRoom {
  Readers reader = inColumn;               ///< whose columns are printed
  double width = 84 * pointsOfMillimetre;  ///< points
  double fontSize = 9;                     ///< points
};

/// A table for a paper: a bare `tabular` of the package booktabs, which the paper puts into a table
/// with a caption of its own. The table's title, its caption and the rows' remarks stand before it
/// as comments. A row's mark stands before its name; rows apart are ruled off.
///
/// It is no wider than the room where that is possible. First its headings are broken into lines,
/// then its texts, the widest column first: behind hyphens, spaces, slashes, underscores, commas
/// and colons (breakableParts). A part that is wider than its column is cut and ends in "…". In a
/// column an interval of two ends without signs has a dash: "0.78–2.41".
/// Numbers stay whole: a table of too many of them is wider than the room (fitsTabular).
/// @throws InternalError for a number that is not finite
std::string latexTabular(const Table& table, const TabularRoom& room = {});

/// Whether the table can be as narrow as the room.
bool fitsTabular(const Table& table, const TabularRoom& room);

/// How wide a figure or a table of a paper is.
enum class PaperWidth {
  column,  ///< one of two columns: 84 mm
  page,    ///< both of them: 178 mm
};

/// "column" or "page".
const char* paperWidthName(PaperWidth width);

/// 84 or 178.
double millimetresOf(PaperWidth width);

/// What a run writes for a paper.
struct PaperOptions {
  std::vector<PaperWidth> widths = {};    ///< of the figures that are wanted, each once
  double fontSize = 9;                    ///< of the text of figures and tables, points
  std::vector<std::string> methods = {};  ///< labels of those that they show; none for the rule
  std::vector<std::string> columns = {};  ///< keys of the tables' columns (paperColumnKeys); none
                                          ///< for the default
};

/// The room of a table.
TabularRoom roomOf(PaperWidth width, double fontSize);

}  // namespace gnomon::report
