#pragma once

#include <string_view>

#include "study/record/record.h"

namespace gnomon::report {

/// "pass", "fail" or "not judged": in every kind of report.
std::string_view runStatusName(study::RunStatus status);

/// "study", "mesh", "image" or "shader".
std::string_view inputKindName(study::InputRecord::Kind kind);

/// "better", "worse", "equal", "not distinguishable" or "no interval": the first of two methods.
std::string_view differenceVerdictName(study::DifferenceVerdict verdict);

/// "shaded", "difference" or "displaced".
std::string_view pictureKindName(study::PictureRecord::Kind kind);

}  // namespace gnomon::report
