#pragma once

#include <string>
#include <vector>

#include "study/record/record.h"

namespace gnomon {

/// What a record says of how sure its error rates are, the same in every kind of report.

/// The views that have intervals, in the record's order.
std::vector<std::string> confidenceViews(const StudyRecord& record);

/// The methods of a view from the lowest error rate to the highest, all lights together; equal ones
/// keep the record's order.
std::vector<ConfidenceRecord> rankedIn(const StudyRecord& record, const std::string& view);

/// What can be said of the best method of a view, as sentences: "A is better than B by 1.06 % of
/// the samples (0.75 to 1.32)", B being the next that it can be told from, and which it cannot.
/// Empty where there is nothing to compare.
std::string verdictText(const StudyRecord& record, const std::string& view);

/// What stands behind a method's row: " ≈" where it is not distinguishable from the best, †
/// (radiusMark) where that depends on the search radius. Two columns at most.
std::string differenceMark(const DifferenceRecord& toBest);

/// What the intervals of a view are, how many blocks they rest on, and how sure the truth is.
std::string confidenceNote(const StudyRecord& record, const std::string& view);

}  // namespace gnomon
