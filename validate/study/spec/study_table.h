#pragma once

#include <toml++/toml.h>

#include <filesystem>

#include "study/spec/study_file.h"

namespace gnomon::study {

/// A study's file with the overrides and replacements of the options in it: what `readStudy` reads.
/// @throws InputError and UsageError as parseToml and replaceMethods
toml::table studyTable(const StudyText& study, const StudyOptions& options);
toml::table studyTable(const std::filesystem::path& file, const StudyOptions& options);

}  // namespace gnomon::study
