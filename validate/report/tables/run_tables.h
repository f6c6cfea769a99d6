#pragma once

#include <vector>

#include "report/tables/table.h"
#include "study/record/record.h"

namespace gnomon::report {

/// Tables of a run itself.

/// The truth's uncertainty in each view under each light.
Table flipTable(const std::vector<study::UncertaintyRecord>& flips);
/// The time of each stage, seconds.
Table timingTable(const std::vector<study::TimingRecord>& timings);
/// Each file that the run was made of.
Table inputTable(const std::vector<study::InputRecord>& inputs);

}  // namespace gnomon::report
