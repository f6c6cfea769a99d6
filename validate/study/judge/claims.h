#pragma once

#include <span>
#include <vector>

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

}  // namespace gnomon::study
