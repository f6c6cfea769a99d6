#pragma once

#include <string>

#include "report/tables/table.h"
#include "report/text/terminal_page.h"

namespace gnomon::report {

/// Adds a table to a terminal's page, at most 100 columns wide: texts at the left, figures at the
/// right of their columns, a row's mark behind it and its remark below it. Where the room is short,
/// texts are cut ("…"), the widest first, but not below 30 columns together; then figures that do
/// not fit beside each other follow in further blocks, each with its rows' names.
/// @throws InternalError for a number that is not finite
void appendTable(TerminalPage& page, const Table& table);

/// The table alone, as plain text.
std::string terminalTable(const Table& table);

}  // namespace gnomon::report
