#pragma once

#include <vector>

#include "study/record.h"
#include "study/study_file.h"

namespace gnomon {

/// Judges every gate on every result that it matches: passed only if the metric is defined and
/// `value <= maximum` and `value >= minimum` hold, so that NaN and undefined values fail.
/// @throws InputError for a gate that matches no result: a gate that never closes is a fault
std::vector<ThresholdRecord> judgeThresholds(const std::vector<ThresholdSpec>& thresholds,
                                             const std::vector<ResultRecord>& results);

}  // namespace gnomon
