#pragma once

#include <span>
#include <vector>

#include "study/record/check_record.h"
#include "study/record/record.h"

namespace gnomon {

/// The limits of a study that are looser than they need be: those whose nearest value, over all
/// rows and steps that they gate, keeps off them by more than a quarter of the limit and by more
/// than four of the tolerances of `toleranceOf`. A limit with a failed or undefined row is none.
/// @param steps  the records of the study's steps, each with its judgements
std::vector<NoticeRecord> looseThresholds(std::span<const Gate> thresholds,
                                          std::span<const StudyRecord> steps);

}  // namespace gnomon
