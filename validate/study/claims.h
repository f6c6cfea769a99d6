#pragma once

#include <span>
#include <vector>

#include "study/record.h"
#include "study/study_file.h"
#include "study/sweep_record.h"

namespace gnomon {

/// Judges the claims of one study of a run.
///
/// "`less` has a smaller metric than `than`" is judged in every light and view, over the samples of
/// the claim's region, where both have a value:
///   held                 smaller everywhere, by more than the truth's uncertainty there
///   failed               larger somewhere, by more than that
///   not distinguishable  anything between
/// "The metric of `method` lies `above` and `below`" likewise:
///   held                 within the bounds everywhere, also when moved by the uncertainty
///   failed               outside somewhere, also when moved by it
///   not distinguishable  anything between
/// The truth's uncertainty is the share of samples that flip at half its resolution; in a region,
/// as if all of them lay in it, so that it is never too small; of a boundary metric or a length
/// ratio, `metricUncertainty`: by how much the coarser truth's own differs from that of a perfect
/// mask. Where no case has a value, the claim is not evaluated.
/// With `gainExceeds` the mean of (than - less) over lights and views is compared with the same
/// mean in the study of that name, by the sum of both studies' largest uncertainties; without that
/// study in the run the claim is not evaluated, and says what to run. A claim with `gainGrows` is
/// not evaluated in a single study.
/// @param run  the records of all studies of this run
/// @param own  which of them the claims belong to
std::vector<ClaimRecord> judgeClaims(const std::vector<ClaimSpec>& claims,
                                     std::span<const StudyRecord> run, std::size_t own);

/// Judges the claims of a sweep over all its steps, whose own verdicts are known.
///
/// With `gainGrows` the mean of (than - less) over lights and views at the last value is compared
/// with that at the first, by the sum of both steps' largest uncertainties. Any other claim failed
/// if it failed at some value, held if it held at every one, and is otherwise not distinguishable,
/// or not evaluated where no step says more than that; its detail names the values of each verdict.
std::vector<ClaimRecord> judgeSweepClaims(const std::vector<ClaimSpec>& claims,
                                          const SweepRecord& sweep);

}  // namespace gnomon
