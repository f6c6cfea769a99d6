#pragma once

#include <string>

#include "report/tables/table.h"

namespace gnomon::report {

/// A table for programs, as RFC 4180 quotes it; lines end in LF. A number is the shortest text that
/// reads back as itself, whatever it reads as for people; what there is none of, an empty cell. An
/// interval takes two columns, `low` and `high`, after its column's key and `_`, if it has one.
///
/// A cell that begins with = + - @ (of full width too), a tab or CR, and is no number, gets an
/// apostrophe before it: spreadsheets would take it for a formula. What `xmlText` refuses becomes
/// U+FFFD.
/// @throws InternalError for a number that is not finite
std::string csvTable(const Table& table);

}  // namespace gnomon::report
