#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/page/html_page.h"
#include "report/plots/gnuplot.h"
#include "report/run_folder.h"
#include "report/tables/latex_table.h"
#include "report/tables/table.h"
#include "report/text/html.h"
#include "study/judge/ranking.h"
#include "study/judge/suite/chosen_settings.h"
#include "study/judge/suite/suite_statistics.h"

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

/// Writes what the studies of one suite come to, beside their folders: suite.csv, suite.md,
/// suite.html, its plots as plots/suite-*.svg and .pdf, and what papers take (paper_files.h).
/// suite.json is left to the caller.
/// @param studies  that the statistics were made of
/// @param command  reproduces the run
/// @param opening  sections of the page before all others
/// @throws InputError for a file that cannot be written; InternalError as the writers
void writeSuiteFiles(const study::SuiteStatistics& statistics,
                     std::span<const study::StudyMeans> studies, std::string_view command,
                     const PaperOptions& paper, RunFolder& folder,
                     const std::vector<PageSection>& opening = {});

/// What of a suite is written.
enum class SuiteParts { all, figures };

/// Writes them, and suite.json, where suiteOf names a suite; of the figures alone suite.csv,
/// suite.md and suite.json, without pages to lead to.
/// @returns whether it does
bool writeSuiteOf(std::span<const study::StudyMeans> studies, std::string_view command,
                  SuiteParts parts, const PaperOptions& paper, RunFolder& folder);

/// The value of "schema". A reader may rely on the keys below as long as it does not change.
constexpr std::string_view suiteSchema = "gnomon-suite/1";

/// The statistics over the scenes of a suite as JSON: schemas/gnomon.schema.json documents every
/// key.
/// @throws InternalError naming the key for a number that is not finite
std::string suiteJson(const study::SuiteStatistics& statistics, std::string_view command);

/// The settings that were tried on train: a row a value, with its mean error over the scenes and a
/// mark for the value that was chosen.
Table suiteSettingsTable(const study::SuiteMethods& methods,
                         const std::vector<study::TriedSetting>& tried);

/// The chosen methods as the file that `gnomon suite --settings` reads, with what they were chosen
/// from as a comment.
/// @param scenes  "suite-1, 200 scenes"
std::string chosenSettingsText(const study::SuiteMethods& methods,
                               const std::vector<study::TriedSetting>& tried,
                               const std::string& scenes);

/// The statistics over the scenes of a suite as one page that loads nothing: the ranked methods,
/// their errors as curves, who beats whom, where methods fail, and the hardest scenes. It lies
/// beside the scenes' folders and links to their reports.
/// @param plots    suitePlots of the statistics
/// @param command  reproduces the run
/// @throws InternalError for a number that is not finite
Html suiteHtml(const study::SuiteStatistics& statistics, const std::vector<DrawnPlot>& plots,
               std::string_view command, const std::vector<PageSection>& opening = {});

}  // namespace gnomon::report
