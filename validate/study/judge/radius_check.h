#pragma once

#include "study/record/record.h"
#include "study/record/sweep_record.h"
#include "study/spec/study_file.h"

namespace gnomon {

/// How a study is judged again at half and at twice its search radius, since a verdict that hangs
/// on that choice is none.

/// The study with every method's search radius times a factor: of its tables and of its march. The
/// study's own radius stays, by which the truth parts its regions, so that only the methods'
/// answers differ. Without thresholds and ladders, which speak of the study as it is.
StudySpec withRadiusTimes(StudySpec study, double factor);

/// Keeps beside every claim and every difference what becomes of it at half and at twice the
/// radius.
/// @param half, twice  of the same study, their claims judged
/// @throws InternalError where they have other claims or differences
void keepRadiusChecks(StudyRecord& record, const StudyRecord& half, const StudyRecord& twice);
void keepRadiusChecks(SweepRecord& sweep, const SweepRecord& half, const SweepRecord& twice);

}  // namespace gnomon
