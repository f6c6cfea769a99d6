#pragma once

#include <string>

#include "study/record/sweep_record.h"

namespace gnomon {

/// A sweep for the terminal, at most 100 columns wide: the mean error rates in percent, one row a
/// method and one column a value, as many values side by side as fit; then the claims with their
/// verdicts over the sweep, and the thresholds that failed.
/// @param colours  as `resultTable` takes it
std::string sweepTable(const SweepRecord& sweep, bool colours);

}  // namespace gnomon
