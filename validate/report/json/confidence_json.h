#pragma once

#include "report/json/json_values.h"
#include "study/record/record.h"

namespace gnomon {

/// One error rate with its interval: method, view, light ("all": the mean over all lights),
/// error_rate, low, high (the 95 % interval; null where there is none), reason (why there is none,
/// or null), blocks, block_side.
Json jsonConfidence(const ConfidenceRecord& confidence);

/// The difference of two methods: view, light ("all": the mean over the lights), first, second,
/// difference (error rate of the first less that of the second), low, high (its 95 % interval; null
/// where there is none), reason (why there is none, or null), uncertainty (of the truth), verdict
/// ("better", "worse", "not distinguishable": of the first).
Json jsonDifference(const DifferenceRecord& difference);

}  // namespace gnomon
