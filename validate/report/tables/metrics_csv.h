#pragma once

#include <string>

#include "study/record/record.h"

namespace gnomon {

/// All results as a tidy table: one row a method × light × view × region, in the record's order,
/// with the columns study, method, light, view, region, samples, tp, fp, fn, tn, then every metric
/// by name. Quoted as RFC 4180 says, lines end in LF; a number is the shortest text that reads back
/// as itself, an undefined metric an empty cell.
/// @throws InternalError for a number that is not finite
std::string metricsCsv(const StudyRecord& record);

}  // namespace gnomon
