#pragma once

#include <optional>
#include <vector>

#include "study/record/record.h"
#include "study/run/driver_faults.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// The part of a study that the driver can measure.
struct MeasurableStudy {
  std::vector<RefusedMethod> refused;
  /// The study without them and their ladders; none where nothing is refused.
  std::optional<StudySpec> reduced;
};

/// Refuses the methods that need a pass that the driver draws wrong.
/// @throws DriverError where no method is left, where another state of a ladder that is left needs
///   such a pass, and as DriverFaults::requireViews
MeasurableStudy measurable(const StudySpec& study, DriverFaults& faults);

/// Adds the refused methods to a record: for each a notice and a problem, so that the run does not
/// pass, and an undefined value, which fails, for each of its gates.
/// @param study  as its file asks for it
void addRefused(StudyRecord& record, const StudySpec& study,
                const std::vector<RefusedMethod>& refused);

}  // namespace gnomon::study
