#pragma once

#include <string>
#include <string_view>

#include "study/record.h"

namespace gnomon {

/// The value of "schema". A reader may rely on the keys below as long as it does not change.
constexpr std::string_view summarySchema = "gnomon-summary/1";

/// A whole run as JSON, keys in a fixed order, text as UTF-8 (bytes that are not become U+FFFD):
///   schema, status ("pass" or "fail"), study, environment, truth, methods, results, confidence,
///   differences, bins, cost, timings, thresholds, claims, budget, panels, undefined_samples
/// A row of `results` has method, light, view, region, samples, the cells tp, fp, fn, tn (areas in
/// weighted views), every metric by name, and `undefined`: for each metric that is null, why.
/// The rows of `confidence`, `differences`, `bins` and `budget` are those of jsonConfidence,
/// jsonDifference, jsonBin and jsonBudget.
/// A row of `cost` has method, polygons, table_bytes, height_bytes, frame_ms (null where no camera
/// view is timed), passes, and frame_ratio (see frameRatio; null likewise).
/// @throws InternalError naming the key for a number that is not finite
std::string summaryJson(const StudyRecord& record);

}  // namespace gnomon
