#include "study/record.h"

#include <algorithm>

namespace gnomon {

bool StudyRecord::passed() const {
  return std::all_of(thresholds.begin(), thresholds.end(),
                     [](const ThresholdRecord& threshold) { return threshold.passed; });
}

}  // namespace gnomon
