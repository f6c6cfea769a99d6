#pragma once

#include <string>

#include "study/spec/sections/study_key.h"
#include "study/spec/study_file.h"
#include "study/spec/toml_reader.h"

namespace gnomon::study {

/// The sections of a study's file, as the keys of its root.
StudyKeys studySections();

/// All keys of all sections as Markdown: name, values, default and meaning of each, from the very
/// declarations that a study is read by.
std::string studyKeysText();

/// Reads `max` and `min` of a `[[threshold]]`, at least one of them, for the metric, region and
/// view that `threshold` already has. Each is a number, or of a share also a percentage: "5 %".
/// @throws InputError as TomlReader for limits that could never fail or never hold: see
///   requireInRange and requireMissable, with the largest of the views that the threshold matches,
///   in the full form; and for a metric that the region alone settles, as false light among samples
///   that are lit
void readLimits(const TomlReader& section, const StudySpec& study, Gate& threshold);

}  // namespace gnomon::study
