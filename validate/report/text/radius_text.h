#pragma once

#include <string>

#include "report/json/json_values.h"
#include "study/record/record.h"

namespace gnomon {

/// What a verdict owes to the search radius: "depends on the radius: failed at half of it, held at
/// twice". Empty where it stays the same, and where the radius was not varied. Terminal and pages
/// show it; `jsonRadiusCheck` says the same in files.
std::string radiusNote(const ClaimRecord& claim);
std::string radiusNote(const DifferenceRecord& difference);

/// half, twice: the verdicts there; depends: whether one of them is another. Null where the radius
/// was not varied.
Json jsonRadiusCheck(const ClaimRecord& claim);
Json jsonRadiusCheck(const DifferenceRecord& difference);

/// Marks a verdict that depends on the radius in a table.
inline constexpr const char* radiusMark = "†";

}  // namespace gnomon
