#pragma once

#include <string>

#include "study/record/record.h"

namespace gnomon {

/// A run for the terminal, at most 100 columns wide: the verdict of each view (appendConfidence),
/// then for each view and light one row a method with
/// its error rate, both parts of it, IoU and BER in percent, beside the truth's own uncertainty.
/// A view with more than three lights becomes one block, its rows named by light and method. Then
/// the claims with their verdicts, the thresholds that failed, what each method costs, and the time
/// of each stage.
/// @param colours  ANSI colours and bold face; without them the text is plain
std::string resultTable(const StudyRecord& record, bool colours);

}  // namespace gnomon
