#pragma once

#include "study/record/record.h"
#include "study/record/sweep_record.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// Judges a study again at half and at twice its search radius: a verdict that changes with that
/// choice cannot be relied on.

/// The study with every method's search radius times a factor: of its tables and of its march. The
/// truth keeps the study's radius for its regions, so that only the methods' answers differ.
/// Thresholds and ladders are left out: they are about the study as written.
StudySpec withRadiusTimes(StudySpec study, double factor);

/// Stores with every claim and every difference its verdicts at half and at twice the radius.
/// @param half, twice  of the same study, their claims judged
/// @throws InternalError where they have other claims or differences
void keepRadiusChecks(StudyRecord& record, const StudyRecord& half, const StudyRecord& twice);
void keepRadiusChecks(SweepRecord& sweep, const SweepRecord& half, const SweepRecord& twice);

}  // namespace gnomon::study
