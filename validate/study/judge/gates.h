#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/rates.h"
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

}  // namespace gnomon::study
