#pragma once

#include <string>

#include "study/record/sweep_record.h"

namespace gnomon {

/// The results of a sweep as a tidy table, without the times of frames, which no two runs share: one row
/// a value × method; an unknown figure is an empty cell.
std::string sweepCsv(const SweepRecord& sweep);

}  // namespace gnomon
