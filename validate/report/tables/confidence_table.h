#pragma once

#include <string>

#include "report/tables/table.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The methods of a view from the lowest error rate to the highest, each with its interval, and how
/// much worse than the best it is, with the interval of that; signs as differenceSign has them.
/// Without rows if the record has no intervals.
Table confidenceTable(const study::StudyRecord& record, const std::string& view);

}  // namespace gnomon::report
