#pragma once

#include <filesystem>
#include <vector>

#include "study/judge/ranking.h"
#include "study/judge/suite/chosen_settings.h"

namespace gnomon::report {

/// A scene of a suite that an earlier run measured.
struct FinishedScene {
  std::filesystem::path folder;  ///< of its run
  study::StudyMeans means;
};

/// Reads the scenes of a folder of results from the summaries that finished runs left in it: in its
/// own, or in those of its subfolders, by name. Runs of studies that were not drawn for a suite,
/// sweeps, and runs that were not finished are left out.
/// @throws InputError where the folder cannot be read, or a summary is damaged
std::vector<FinishedScene> readFinishedScenes(const std::filesystem::path& folder);

/// The ranking that a suite.json holds.
/// @throws InputError where it cannot be read or is damaged
study::SuiteRanking readSuiteRanking(const std::filesystem::path& file);

}  // namespace gnomon::report
