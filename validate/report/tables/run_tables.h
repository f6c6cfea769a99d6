#pragma once

#include <vector>

#include "report/tables/table.h"
#include "study/record/record.h"

namespace gnomon {

/// Tables of a run itself.

/// The truth's uncertainty in each view under each light.
Table flipTable(const std::vector<UncertaintyRecord>& flips);
/// Step, micro-triangles and flip rate of each level of a refinement.
Table refinementTable(const std::vector<RefinementRecord>& levels);
/// The time of each stage, seconds.
Table timingTable(const std::vector<TimingRecord>& timings);
/// Each file that the run was made of.
Table inputTable(const std::vector<InputRecord>& inputs);

}  // namespace gnomon
