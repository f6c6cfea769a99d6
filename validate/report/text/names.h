#pragma once

#include <string_view>

#include "study/record/record.h"

namespace gnomon {

/// "held", "failed", "not distinguishable" or "not evaluated", the same in every kind of report.
std::string_view verdictName(Verdict verdict);

/// "pass", "fail" or "not judged": in every kind of report.
std::string_view runStatusName(RunStatus status);

/// "study", "mesh", "image" or "shader".
std::string_view inputKindName(InputRecord::Kind kind);

/// "better", "worse" or "not distinguishable": the first of two methods.
std::string_view differenceVerdictName(DifferenceVerdict verdict);

/// "shaded", "difference" or "displaced".
std::string_view pictureKindName(PictureRecord::Kind kind);

}  // namespace gnomon
