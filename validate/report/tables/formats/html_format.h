#pragma once

#include "report/tables/table.h"
#include "report/text/html.h"

namespace gnomon::report {

/// A table for a page: a <table> of its kind's class, inside a box that scrolls sideways where the
/// screen is narrow. What a cell is `about` shows to whoever points at it.
/// @throws InternalError for a number that is not finite
Html htmlTable(const Table& table);

}  // namespace gnomon::report
