#pragma once

#include <span>
#include <string>
#include <string_view>

#include "study/judge/ranking.h"
#include "study/record/sweep_record.h"
#include "study/spec/suite/drawn_suite.h"

namespace gnomon::report {

/// The value of "schema". A reader may rely on the keys below as long as it does not change.
constexpr std::string_view rankingSchema = "gnomon-ranking/2";

/// The ranking of methods over all studies of a run, as JSON: schemas/gnomon.schema.json documents
/// every key.
/// @throws InternalError naming the key for a number that is not finite
std::string rankingJson(std::span<const study::StudyMeans> studies, std::string_view command);

/// The manifest of a drawn suite: its name, seed and split, its one SHA-256, and every file with
/// its own; of a study also that of its scene, and what was drawn. docs/suite.md names the keys.
std::string suiteManifest(const study::DrawnSuite& suite);

/// The value of "schema". A reader may rely on the keys below as long as it does not change.
constexpr std::string_view sweepSchema = "gnomon-sweep/3";

/// A sweep as JSON: schemas/gnomon.schema.json documents every key.
/// @throws InternalError naming the key for a number that is not finite
std::string sweepJson(const study::SweepRecord& sweep);

}  // namespace gnomon::report
