#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/judge/distinguish.h"
#include "study/record/claim_spread.h"
#include "study/record/record.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// The cases of a claim, which claims.h explains.

/// The figures of a claim in one view under one light.
struct ClaimCase {
  std::string view;
  /// Of the claim's `method` its value; of two methods the value of `than` less that of `less`.
  Estimate estimate;
  std::optional<double> quantity;  ///< what the spread's quartiles are of; see ClaimSpread
};

struct ClaimCases {
  std::vector<ClaimCase> defined;
  std::size_t undefined = 0;  ///< in which the claim's method has no value
};

ClaimCases casesOf(const ClaimSpec& claim, const StudyRecord& study);

/// How uncertain the truth is in a row's metric: of a rate the share of samples that flip, in a
/// region as if all of them lay in it; of any other metricUncertainty, which may be infinite.
double uncertaintyIn(const StudyRecord& study, const ResultRecord& row, compare::MetricId metric);

/// A figure's bounds, themselves not included.
struct Bounds {
  std::optional<double> above, below;
};

/// The bounds of a claim; one about two methods asks for a difference above 0.
Bounds boundsOf(const ClaimSpec& claim);

/// Whether a figure lies within the bounds, by `distinguish`: failed where it is on the wrong side
/// of one, held where it is on the right side of each; else what `distinguish` says of the first
/// bound that leaves it open.
Verdict judgeWithin(const Estimate& estimate, const Bounds& bounds);

/// The verdicts on all cases, and on their mean where it has an interval.
/// @param cases  one or more
ClaimSpread spreadOver(const ClaimSpec& claim, const StudyRecord& study,
                       const std::vector<ClaimCase>& cases);

/// @param detail  why it is not evaluated
ClaimRecord notEvaluated(const ClaimSpec& claim, std::string detail);

/// Whether the claim's metric has intervals: the score does.
bool hasIntervals(const ClaimSpec& claim);

/// "; no interval exists for it, …", or nothing where one does.
std::string intervalNote(const ClaimSpec& claim);

/// " in the region cast", or nothing for all samples.
std::string regionText(const ClaimSpec& claim);

/// A difference as texts show it: rates in points of a hundred, all others as they are.
std::string differenceText(compare::MetricId metric, double difference);

/// The mean of the cases' estimates, without their intervals.
/// @param cases  one or more
double meanValue(const std::vector<ClaimCase>& cases);

}  // namespace gnomon::study
