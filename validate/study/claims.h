#pragma once

#include <span>
#include <vector>

#include "study/record.h"
#include "study/study_file.h"
#include "study/sweep_record.h"

namespace gnomon {

/// Judges the claims of one study of a run.
///
/// "`less` has a smaller metric than `than`" is judged in every light and view over all samples:
///   held                 smaller everywhere, by more than the truth's uncertainty there
///   failed               larger somewhere, by more than that
///   not distinguishable  anything between
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
