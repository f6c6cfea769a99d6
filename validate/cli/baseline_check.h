#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "study/baseline.h"
#include "study/gate_record.h"

namespace gnomon {

/// The file of a study's references in a folder: `NAME.json`.
std::filesystem::path baselineFile(const std::filesystem::path& folder, const std::string& study);

/// What a run is, that its references must be of too.
struct BaselineRun {
  std::string study;
  bool quick = false;
  std::string reason = {};  ///< of an update
};

/// Judges a run by its references and adds the gates and notices to the check.
/// @throws InputError naming the file: it is missing or no baseline, or is of another study, form
///   or set of rows
void checkBaseline(const std::filesystem::path& file, const BaselineRun& run,
                   std::span<const StudyRecord> steps, const std::vector<std::string>& leftOut,
                   CheckRecord& check);

/// Writes a run's values as references, with the reason after those of the file that was there, and
/// tells of it in a notice. Leaves the file alone where the check has not passed, and where every
/// value is the one that it holds: its reasons are those of its values.
/// @throws InputError for a file that is there and is no baseline, so that its history is not lost;
///   and where the run has no value to write
void updateBaseline(const std::filesystem::path& file, const BaselineRun& run,
                    std::span<const StudyRecord> steps, CheckRecord& check);

}  // namespace gnomon
