#pragma once

#include "study/spec/study_file.h"
#include "study/spec/toml/toml_reader.h"

namespace gnomon::study {

/// Reads `max` and `min` of a `[[threshold]]`, at least one of them, for the metric, region and
/// view that `threshold` already has. Each is a number, or of a share also a percentage: "5 %".
/// @throws InputError as TomlReader for limits that could never fail or never hold: see
///   requireInRange and requireMissable, with the largest of the views that the threshold matches,
///   in the full form; and for a metric that the region alone settles, as false light among samples
///   that are lit
void readLimits(const TomlReader& section, const StudySpec& study, Gate& threshold);

}  // namespace gnomon::study
