#pragma once

#include <string>
#include <string_view>

#include "study/record/record.h"

namespace gnomon::report {

/// The value of "schema". A reader may rely on the keys below as long as it does not change.
constexpr std::string_view summarySchema = "gnomon-summary/2";

/// A whole run as JSON, keys in a fixed order, text as UTF-8 (bytes that are not become U+FFFD).
/// docs/summary.md documents every key.
/// @throws InternalError naming the key for a number that is not finite
std::string summaryJson(const study::StudyRecord& record);

}  // namespace gnomon::report
