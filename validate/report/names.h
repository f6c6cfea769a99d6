#pragma once

#include <string_view>

#include "study/record.h"

namespace gnomon {

/// "held", "failed", "not distinguishable" or "not evaluated", the same in every kind of report.
std::string_view verdictName(Verdict verdict);

/// "shaded", "difference" or "displaced".
std::string_view pictureKindName(PictureRecord::Kind kind);

}  // namespace gnomon
