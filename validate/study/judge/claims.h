#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/judge/distinguish.h"
#include "study/record/gate.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// Judges the claims of a study.
///
/// A case is one view under one light in which the claim's metric is defined, over the samples of
/// the claim's region. "`less` has a smaller metric than `than`" holds in a case where `less` is
/// better than `than` by `distinguish`, and fails there where it is worse. "The metric of `method`
/// lies `above` and `below`" holds in a case where the value is on the right side of every bound by
/// `distinguish`, and fails where it is on the wrong side of one. Over all cases:
///   held                 it fails in none, and holds for the mean over all of them together, by
///                        the interval of that mean; without intervals: it holds in every case
///   failed               it fails in at least one case, or for that mean
///   equal                both methods give the same answers in every case
///   no interval          too little is known in some cases, and it holds in all others
///   not distinguishable  anything between
///   not evaluated        no case has a value
/// The mean is that over all lights together of each view (differenceOverViews), and has a narrower
/// interval than a single light: a claim may hold although some lights alone do not decide it. The
/// report also says in how many cases it holds alone.
///
/// *With an interval or without.* Only the error rate over all samples has intervals: of the value,
/// and of the paired difference of two methods. Where such an interval was refused, nothing is
/// known of the case. Claims about regions and other metrics are judged by the truth's uncertainty
/// alone (withoutInterval), and their detail says so. That uncertainty is the share of samples that
/// flip at half its resolution; in a region, as if all of them lay in it, so that it is never too
/// small; of a boundary metric or a length ratio, `metricUncertainty`: by how much the coarser
/// truth's own differs from that of a perfect mask.
std::vector<ClaimRecord> judgeClaims(const std::vector<ClaimSpec>& claims,
                                     const StudyRecord& study);

/// Judges the claims of a sweep over all its steps, whose own verdicts are known.
/// A claim has the verdict over its values that a study's has over its cases, or is not evaluated
/// where no step says more than that; its detail names the values of each verdict.
std::vector<ClaimRecord> judgeSweepClaims(const std::vector<ClaimSpec>& claims,
                                          const SweepRecord& sweep);

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
