#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

#include "study/record/record.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// The copy of a study that a run writes into its folder, so that the run can be repeated from
/// there.

/// The name of the study's copy in a run's folder: "figure8.toml"; of a sweep's step, whose folder
/// is NAME/VALUE, "NAME-VALUE.toml".
std::string studyCopyName(const std::string& study);

/// A study with every setting in effect: defaults, overrides, replacements, those of the quick form
/// and a sweep's value are written out, each light has a table of its own, and every method all its
/// parameters. Reading it without any option gives the same study to the bit. Thresholds, claims
/// and ladders are those that the run judges; a claim over a sweep is gone with the sweep. A step's
/// `study.name` is that of its copy, since a name may hold no `/`.
/// @param folder  that the file will lie in: paths are relative to it
/// @throws InputError for a method's file that cannot be read
toml::table resolvedStudy(const StudySpec& study, const std::filesystem::path& folder);

/// A sweep's file: that of the study, with the options in it, and paths relative to `folder`.
/// Defaults are not written out, since they may depend on the swept key.
/// @param step  any one of the sweep's steps, read with the same options
/// @throws InputError and UsageError as studyTable
toml::table sweepStudy(const StudySpec& step, const StudyOptions& options,
                       const std::filesystem::path& folder);

/// A study of the above as the text of its file: a first line says who wrote it.
/// @throws InputError naming the file for a text that TOML cannot hold
std::string studyCopyText(const toml::table& study, const std::filesystem::path& file);

/// Checks that a study's copy may be written: the file does not exist, or is such a copy.
/// @throws InputError naming the file where it is anything else
void requireCopyOrNothing(const std::filesystem::path& file);

/// Every file that a run of the study reads; some more than once.
/// @throws InputError for a method that cannot be read, or a mask that is missing
std::vector<std::filesystem::path> inputFiles(const StudySpec& study);

/// Every file that a run of the study reads, each once: the study's own, its mesh and image, the
/// shaders of `common/` in alphabetical order, and those of its methods and ladders.
/// @param folder  of the run: the files' paths are relative to it
/// @throws InputError for a file that cannot be read
std::vector<InputRecord> studyInputs(const StudySpec& study, const std::filesystem::path& folder);

}  // namespace gnomon::study
