#pragma once

#include <span>
#include <string>

#include "study/spec/study_file.h"

namespace gnomon {

/// Takes from a study the methods that the command line does not want, and with them the gates,
/// claims and ladders that speak of them; in the quick form also the gates of the full one. What is
/// left out stays named in `leftOut` and `leftOutMethods`.
/// @throws UsageError for a method that the study does not have
void reduce(StudySpec& study, const StudyOptions& options);

/// The study without some of its methods, and without the gates, claims and ladders that speak of
/// them.
StudySpec withoutMethods(StudySpec study, std::span<const std::string> labels);

}  // namespace gnomon
