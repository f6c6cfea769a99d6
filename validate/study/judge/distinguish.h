#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "study/record/record.h"

namespace gnomon {

/// The one place that says whether two figures differ: verdicts, the marks ≈ of all tables, LaTeX,
/// rankings, error budgets and claims ask here.

/// What a difference says of the first of two figures. They are not distinguishable where there is
/// no interval, where the interval of the difference holds 0, or where the difference is at most
/// the truth's uncertainty; otherwise the smaller one is better.
DifferenceVerdict verdictOn(double difference, const std::optional<Interval>& interval,
                            double uncertainty);

/// The same for a metric that has no intervals (all but the error rate of all samples): by the
/// truth's uncertainty alone.
DifferenceVerdict verdictByTruth(double difference, double uncertainty);

/// The same statement of the second method, less the first.
DifferenceRecord swapped(DifferenceRecord difference);

/// Two methods in one view of a record, the first less the second, whichever of them the record
/// names first; none where it has no such pair.
/// @param light  a light's name, or "all"; the only light of a study is both
std::optional<DifferenceRecord> differenceOf(const StudyRecord& record, std::string_view view,
                                             std::string_view light, std::string_view first,
                                             std::string_view second);

/// A method's error rate in one view, with its interval; none where the record has none.
/// @param light  as differenceOf
std::optional<ConfidenceRecord> findConfidence(const StudyRecord& record, std::string_view view,
                                               std::string_view light, std::string_view method);

/// The mean of differences of the same two methods: of their differences, of their intervals' ends
/// (as if all erred together, so never too narrow) and of the truth's uncertainties; without an
/// interval where one of them has none.
/// @param all  one or more
DifferenceRecord meanDifference(const std::vector<DifferenceRecord>& all);

/// The mean over the views in which both methods answer, all lights together; none where there is
/// no such view.
std::optional<DifferenceRecord> differenceOverViews(const StudyRecord& record,
                                                    std::string_view first,
                                                    std::string_view second);

}  // namespace gnomon
