#pragma once

#include <string>
#include <string_view>

#include "report/tables/table.h"

namespace gnomon::report {

/// Text that stands for itself in a cell of a GitHub-flavoured Markdown table, on one line: what
/// Markdown or HTML would read is escaped, and no @name or #1 in it notifies or links anybody.
std::string escapeMarkdown(std::string_view text);

/// A table for a pull request, a README or a notebook, as GitHub-flavoured Markdown: the title and
/// the caption, the table, then the rows' remarks.
/// @throws InternalError for a number that is not finite
std::string markdownTable(const Table& table);

}  // namespace gnomon::report
