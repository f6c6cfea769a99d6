#pragma once

#include <string>
#include <vector>

#include "study/record/record.h"

namespace gnomon::report {

/// Texts about intervals of error rates, the same in every kind of report.

/// The views that have intervals, in the record's order.
std::vector<std::string> confidenceViews(const study::StudyRecord& record);

/// The methods of a view from the lowest error rate to the highest, all lights together; equal ones
/// keep the record's order.
std::vector<study::ConfidenceRecord> rankedIn(const study::StudyRecord& record,
                                              const std::string& view);

/// The verdict on the best method of a view, as sentences: "A is better than B by 1.06 % of the
/// samples (95 % interval 0.75 to 1.32)", where B is the next method that is distinguishable from
/// A; then the methods that answer alike, those that are not distinguishable, and those whose
/// difference from A has no interval. Empty where there is nothing to compare.
std::string verdictText(const study::StudyRecord& record, const std::string& view);

/// Of a view's methods to the best, all lights together, from the lowest error to the highest.
std::vector<study::DifferenceRecord> differencesToBest(const study::StudyRecord& record,
                                                       const std::string& view);

/// What the intervals of a view mean, on how many blocks they rest, and the truth's uncertainty.
std::string confidenceNote(const study::StudyRecord& record, const std::string& view);

}  // namespace gnomon::report
