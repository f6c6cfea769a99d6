#pragma once

#include <string>

#include "study/record/record.h"

namespace gnomon::report {

/// How a verdict depends on the search radius: "depends on the radius: failed at half of it, held
/// at twice". Empty where it stays the same, and where the radius was not varied. Terminal and
/// pages show it.
std::string radiusNote(const study::ClaimRecord& claim);
std::string radiusNote(const study::DifferenceRecord& difference);

/// Marks a verdict that depends on the radius in a table.
inline constexpr const char* radiusMark = "†";

}  // namespace gnomon::report
