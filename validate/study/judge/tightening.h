#pragma once

#include <span>
#include <vector>

#include "study/record/check_record.h"
#include "study/record/record.h"

namespace gnomon::study {

/// A notice for each limit that could be tightened: its nearest value, over all rows and steps that
/// it applies to, is farther from it than a quarter of the limit and four times `toleranceOf`.
/// There is none for a limit with a failed or undefined row.
/// @param steps  the records of the study's steps, each with its judgements
std::vector<NoticeRecord> looseThresholds(std::span<const Gate> thresholds,
                                          std::span<const StudyRecord> steps);

}  // namespace gnomon::study
