#include "report/suite/finished_scenes.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

#include "common/error.h"
#include "report/json/json_values.h"
#include "report/json/summary_json.h"
#include "report/suite/suite_files.h"
#include "report/text/number_text.h"

namespace gnomon::report {
namespace fs = std::filesystem;
namespace {

/// The scene of a summary; none where it is of no suite.
std::optional<FinishedScene> readScene(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  const Json json = readJson(file);
  const JsonReader summary(json, file.string(), "");
  if (summary.text("schema") != summarySchema) return std::nullopt;
  const JsonReader header = summary.object("study").object("settings").object("study");
  if (!header.has("suite")) return std::nullopt;
  return FinishedScene{folder, study::studyMeans(readSummary(summary))};
}

std::vector<fs::path> foldersIn(const fs::path& folder) {
  std::vector<fs::path> folders = {folder};
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure)) {
    if (entry.is_directory(failure)) folders.push_back(entry.path());
  }
  if (failure) {
    throw InputError(fmt::format("{}: cannot be read: {}", folder.string(), failure.message()));
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

}  // namespace

std::vector<FinishedScene> readFinishedScenes(const fs::path& folder) {
  std::vector<FinishedScene> scenes;
  for (const fs::path& run : foldersIn(folder)) {
    std::error_code failure;
    if (!fs::exists(run / "summary.json", failure)) continue;
    if (auto scene = readScene(run)) scenes.push_back(std::move(*scene));
  }
  return scenes;
}

study::SuiteRanking readSuiteRanking(const fs::path& file) {
  const Json json = readJson(file);
  const JsonReader suite(json, file.string(), "");
  const std::string schema = suite.text("schema");
  if (schema != suiteSchema) {
    suite.fail("schema", fmt::format("\"{}\" found, \"{}\" expected", schema, suiteSchema));
  }
  study::SuiteRanking ranking;
  for (const JsonReader& method : suite.list("methods")) {
    if (!method.numberOrNull("rank")) continue;
    ranking.methods.push_back({method.text("label"), method.number("mean")});
  }
  for (const JsonReader& pair : suite.list("pairs")) {
    const std::string verdict = pair.text("verdict");
    if (verdict == differenceVerdictName(study::DifferenceVerdict::better)) {
      ranking.distinguishable.emplace_back(pair.text("first"), pair.text("second"));
    } else if (verdict == differenceVerdictName(study::DifferenceVerdict::worse)) {
      ranking.distinguishable.emplace_back(pair.text("second"), pair.text("first"));
    }
  }
  return ranking;
}

}  // namespace gnomon::report
