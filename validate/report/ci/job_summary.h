#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "study/record/check_record.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The row of results whose reference fails by the most, with its pictures.
struct WorstCase {
  std::string study, method, view, light;
  double margin = 0;             ///< below 0: by how much its worst reference fails
  std::filesystem::path before;  ///< signed differences; empty where none was kept
  std::filesystem::path after;
  std::filesystem::path change;  ///< likewise empty
  std::string note;              ///< why there is no picture of before
};

/// Of all rows that have pictures (referencePictures) the one that fails by the most, of metrics
/// that are shares; lengths count only where no share fails. None without such a row.
/// @param out  the folder that holds the records' folders
std::optional<WorstCase> worstCase(std::span<const study::StudyRecord> records,
                                   const std::filesystem::path& out);

/// A check as the Markdown of a build server's job summary: the outcome, every gate that does not
/// hold with its value, limit and shader, all problems, the worst case as three mosaics (mosaic.h)
/// beside the names of the pictures, and the command that accepts the change.
/// @param accept  that command; empty where there are no references
/// @throws InputError where a picture cannot be read
std::string jobSummary(std::span<const study::CheckRecord> checks,
                       const std::optional<WorstCase>& worst, const std::string& accept);

}  // namespace gnomon::report
