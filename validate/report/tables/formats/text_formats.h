#pragma once

#include <string>
#include <string_view>

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

/// Text that stands for itself in a cell of a GitHub-flavoured Markdown table, on one line: what
/// Markdown or HTML would read is escaped, and no @name or #1 in it notifies or links anybody.
std::string escapeMarkdown(std::string_view text);

/// A table for a pull request, a README or a notebook, as GitHub-flavoured Markdown: the title and
/// the caption, the table, then the rows' remarks.
/// @throws InternalError for a number that is not finite
std::string markdownTable(const Table& table);

}  // namespace gnomon::report
