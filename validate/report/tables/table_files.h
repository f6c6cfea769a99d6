#pragma once

#include <string>

#include "study/record/record.h"

namespace gnomon {

/// The ranked table of a study, for a paper.

/// As CSV, best first: rank, method, error_rate, low, high (its 95 % interval), uncertainty (of the
/// truth), same_as_best (1: not distinguishable from the first),
/// false_shadow, false_light, iou, bytes (tables and height map), frame_ms. Rates are means over
/// lights and views, 0 to 1; an unknown figure is an empty cell.
/// @throws InternalError for a number that is not finite
std::string tableCsv(const StudyRecord& record);

/// As a LaTeX table of the package booktabs: the same in percent, the caption says how sure the
/// truth is.
/// @throws InternalError likewise
std::string tableTex(const StudyRecord& record);

}  // namespace gnomon
