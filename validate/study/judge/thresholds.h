#pragma once

#include <string>
#include <vector>

#include "study/record/gate.h"
#include "study/record/record.h"
#include "study/spec/study_file.h"

namespace gnomon {

/// Judges every gate on every result that it matches: passed only if the metric is defined and
/// `value <= maximum` and `value >= minimum` hold, so that NaN and undefined values fail.
/// @throws InputError for a gate that matches no result: a gate that never closes is a fault
std::vector<ThresholdRecord> judgeThresholds(const std::vector<ThresholdSpec>& thresholds,
                                             const std::vector<ResultRecord>& results);

/// The gate that a run was not to judge.
GateRecord gateOf(const LeftOutThreshold& threshold, const std::string& step);

}  // namespace gnomon
