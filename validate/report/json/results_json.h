#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "study/judge/gates.h"
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

/// The version of a baseline's file; readers refuse another.
constexpr std::string_view baselineSchema = "gnomon-baseline/2";

/// A baseline as JSON, keys in a fixed order, a line for each value:
///   schema, study, form ("full" or "quick"), environment, history, values
/// A row of `history` has reason, gnomon_version, commit (of Gnomon), and where references are kept
/// in a repository repository_commit, which was checked out; the oldest is first. A row of `values`
/// has study (of a sweep: NAME/VALUE), method, view, light, answer, metric, value, spread,
/// tolerance. The environment has neither threads nor cpu: values do not depend on them. No date:
/// the same run gives the same bytes.
/// @throws InternalError naming the key for a number that is not finite
std::string baselineJson(const study::Baseline& baseline);

/// Reads it back.
/// @throws InputError naming the file and, for what is no JSON, the line, else the key: another
///   schema, a key that is missing or of another type, a value twice, a metric that baselines do
///   not hold, a value that its metric cannot have, or a tolerance that is not larger than the
///   spread, larger than toleranceOf it, or so large that nothing could fail
study::Baseline readBaseline(const std::filesystem::path& path);

}  // namespace gnomon::report
