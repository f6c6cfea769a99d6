#pragma once

#include <string>
#include <vector>

#include "study/record/sweep_record.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::study {

/// The sweep of a plan, of which `steps` are the records in the plan's order; its claims judged.
/// @throws InternalError where the number of records is not that of the cases
SweepRecord makeSweepRecord(const StudyPlan& plan, std::vector<StudyRecord> steps,
                            const std::string& command);

}  // namespace gnomon::study
