#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>

#include "study/spec/study_file.h"

namespace gnomon {

/// Studies as a run leaves them in its folder, so that the run can be made again from there.

/// The name of the study's copy in a run's folder: "figure8.toml"; of a sweep's step, whose folder
/// is NAME/VALUE, "NAME-VALUE.toml".
std::string studyCopyName(const std::string& study);

/// A study with every setting that holds: defaults, overrides, replacements, the quick form's and a
/// step's value are in it, each light stands alone, and every method has all its parameters.
/// Reading it without any option gives the same study to the bit. Thresholds, claims and ladders
/// are those that the run judges; a claim over a sweep is gone with the sweep.
/// A step's `study.name` is that of its copy, since a name may hold no `/`.
/// @param folder  that the file will lie in: paths are relative to it
/// @throws InputError for a method's file that cannot be read
toml::table resolvedStudy(const StudySpec& study, const std::filesystem::path& folder);

/// A sweep's file: that of the study, with the options in it, and paths relative to `folder`. Its
/// defaults stay open, since a default may follow from what is swept.
/// @param step  any one of the sweep's steps, read with the same options
/// @throws InputError and UsageError as studyTable
toml::table sweepStudy(const StudySpec& step, const StudyOptions& options,
                       const std::filesystem::path& folder);

/// A study of the above as the text of its file: a first line says who wrote it.
/// @throws InputError naming the file for a text that TOML cannot hold
std::string studyCopyText(const toml::table& study, const std::filesystem::path& file);

/// That a study's copy may be written to a file: nothing is there, or another copy.
/// @throws InputError naming the file for one that somebody else wrote
void requireCopyOrNothing(const std::filesystem::path& file);

}  // namespace gnomon
