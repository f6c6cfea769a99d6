#pragma once

#include <span>
#include <string>

#include "study/spec/study_file.h"

namespace gnomon::study {

/// Removes the methods that command-line options exclude, with the gates, claims and ladders that
/// name them; in the quick form also the gates of the full form alone. `leftOut` and
/// `leftOutMethods` list what was removed.
/// @throws UsageError for a method that the study does not have
void reduce(StudySpec& study, const StudyOptions& options);

/// The study without some of its methods, and without the gates, claims and ladders that name them.
StudySpec withoutMethods(StudySpec study, std::span<const std::string> labels);

}  // namespace gnomon::study
