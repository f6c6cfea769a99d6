#pragma once

#include <string>

#include "study/record/record.h"

namespace gnomon {

/// For each view its verdict and a table: the methods ranked, each with its interval, and the
/// difference to the best with its own. Empty if the record has no intervals.
std::string confidenceSection(const StudyRecord& record);

}  // namespace gnomon
