#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/counts.h"
#include "study/record/cases.h"
#include "study/record/gate.h"
#include "study/record/record.h"

namespace gnomon::study {

/// Checks a value against a gate: passed only if the metric is defined and finite, has a limit, and
/// `minimum <= value` and `value <= maximum` hold; undefined without a finite value, whatever the
/// limits.
Judgement judge(Gate gate, const compare::Metric& found);

/// Judges every threshold on every row of the record that it matches.
/// @throws InputError for a threshold that matches no row, since it could never fail
std::vector<Judgement> judgeThresholds(std::span<const Gate> thresholds, const StudyRecord& record);

/// A notice for each limit that could be tightened: its nearest value, over all rows and steps that
/// it applies to, is farther from it than a quarter of the limit and four times `toleranceOf`.
/// There is none for a limit with a failed or undefined row.
/// @param steps  the records of the study's steps, each with its judgements
std::vector<NoticeRecord> looseThresholds(std::span<const Gate> thresholds,
                                          std::span<const StudyRecord> steps);

}  // namespace gnomon::study
