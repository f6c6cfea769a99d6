#pragma once

#include <string>

#include "report/tables/table.h"

namespace gnomon::report {

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

}  // namespace gnomon::report
