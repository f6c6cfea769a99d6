#pragma once

#include <string>
#include <string_view>

#include "study/sweep_record.h"

namespace gnomon {

/// The value of "schema". A reader may rely on the keys below as long as it does not change.
constexpr std::string_view sweepSchema = "gnomon-sweep/1";

/// A sweep as JSON:
///   schema, status ("pass" or "fail"), study (as in the steps' summaries), environment
///   sweep      key, axis, values
///   steps[]    value, status, summary (path of its summary, relative to this file)
///   results[]  value, method, error_rate, false_shadow, false_light, uncertainty: means over
///              lights and views; bytes (tables and height map), frame_ms: null where not measured
///   claims[]   text, source, verdict, detail: judged over all steps
/// @throws InternalError naming the key for a number that is not finite
std::string sweepJson(const SweepRecord& sweep);

/// The same results as a tidy table, without the times of frames, which no two runs share: one row
/// a value × method; an unknown figure is an empty cell.
std::string sweepCsv(const SweepRecord& sweep);

}  // namespace gnomon
