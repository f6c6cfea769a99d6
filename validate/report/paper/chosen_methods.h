#pragma once

#include <string>
#include <vector>

#include "study/record/sweep_record.h"

namespace gnomon::report {

/// What the table of a sweep is made of, of some methods alone. All methods where `labels` holds
/// none of them.
study::SweepRecord withMethods(const study::SweepRecord& sweep,
                               const std::vector<std::string>& labels);

}  // namespace gnomon::report
