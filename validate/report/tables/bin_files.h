#pragma once

#include <string>

#include "report/json/json_values.h"
#include "study/record/record.h"

namespace gnomon {

/// One bin: method, view, light ("all": the sum over the lights), axis, low, high (null where the
/// bin has no end), samples, the cells tp, fp, fn, tn (areas in weighted views), error_rate,
/// false_shadow, false_light (over the bin's own samples).
Json jsonBin(const BinRecord& bin);

/// The same as a table, one row a bin, in the record's order; a bin without end has an empty cell
/// there.
/// @throws InternalError for a number that is not finite
std::string binsCsv(const StudyRecord& record);

}  // namespace gnomon
