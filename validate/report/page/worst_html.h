#pragma once

#include <vector>

#include "report/text/html.h"
#include "study/judge/ranking.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The section of the places where methods err most: of each method those that its picture records,
/// in the view and under the light where its error is largest, each beside the truth. The methods
/// are the `plottedMethods`. Nothing without an error.
Html worstSection(const study::StudyRecord& record, const std::vector<study::RankedMethod>& ranked);

}  // namespace gnomon::report
