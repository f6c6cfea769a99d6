#pragma once

#include "report/tables/table.h"
#include "report/text/html.h"

namespace gnomon::report {

/// A table for a page: a <table> of its kind's class, inside a box that scrolls sideways where the
/// screen is narrow. What a cell is `about` shows to whoever points at it.
/// @throws InternalError for a number that is not finite
Html htmlTable(const Table& table);

/// An error as a bar, an SVG of its cell's width: false shadow, then false light; round their end
/// the truth's uncertainty as a band, and the 95 % interval as a whisker. Hidden from screen
/// readers: the row has the same figures as text. Empty unless the scale is above 0.
/// @throws InternalError for a number that is not finite
Html htmlErrorBar(const ErrorBar& bar);

}  // namespace gnomon::report
