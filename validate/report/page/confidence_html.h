#pragma once

#include "report/text/html.h"
#include "study/record/record.h"

namespace gnomon {

/// For each view its verdict and a table of its methods, ranked with their intervals. Empty if the
/// record has no intervals.
Html confidenceSection(const StudyRecord& record);

}  // namespace gnomon
