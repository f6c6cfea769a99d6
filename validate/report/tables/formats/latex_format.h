#pragma once

#include <string>
#include <string_view>

#include "report/tables/table.h"

namespace gnomon::report {

/// Text that stands for itself in LaTeX: its special characters are escaped, the signs that reports
/// use beyond ASCII become commands, control characters spaces, what is no UTF-8 '?'. A [ or * at
/// the beginning is put into braces, or the end of a row before it would read it. Other UTF-8 stays
/// as it is, as LaTeX has read it since 2018.
std::string escapeLatex(std::string_view text);

/// A table for a paper, by the package booktabs: its caption is the title, the caption's text and
/// the rows' remarks, its label `tab:` and the table's, in letters, digits and dashes. A row's mark
/// stands before its name; rows apart are ruled off.
/// @throws InternalError for a number that is not finite
std::string latexTable(const Table& table);

}  // namespace gnomon::report
