#pragma once

#include <filesystem>
#include <vector>

#include "study/record/case_record.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// Every file that a run of the study reads; some more than once.
/// @throws InputError for a method that cannot be read, or a mask that is missing
std::vector<std::filesystem::path> inputFiles(const StudySpec& study);

/// Every file that a run of the study reads, each once: the study's own, its mesh and image, the
/// shaders of `common/` in alphabetical order, and those of its methods and ladders.
/// @param folder  of the run: the files' paths are relative to it
/// @throws InputError for a file that cannot be read
std::vector<InputRecord> studyInputs(const StudySpec& study, const std::filesystem::path& folder);

}  // namespace gnomon::study
