#pragma once

#include <span>
#include <string>
#include <string_view>

#include "study/judge/study_ranking.h"

namespace gnomon::report {

/// The value of "schema". A reader may rely on the keys below as long as it does not change.
constexpr std::string_view rankingSchema = "gnomon-ranking/2";

/// The ranking of methods over all studies of a run, as JSON: docs/summary.md documents every key.
/// @throws InternalError naming the key for a number that is not finite
std::string rankingJson(std::span<const study::StudyMeans> studies, std::string_view command);

}  // namespace gnomon::report
