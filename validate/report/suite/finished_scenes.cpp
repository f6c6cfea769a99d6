#include "report/suite/finished_scenes.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

#include "common/error.h"
#include "report/json/json_reader.h"
#include "report/json/summary_json.h"
#include "report/suite/suite_json.h"
#include "report/text/names.h"
#include "study/record/cases.h"

namespace gnomon::report {
namespace fs = std::filesystem;
namespace {

compare::Counts readCounts(const JsonReader& row) {
  compare::Counts counts;
  counts.truePositive = row.number("tp");
  counts.falsePositive = row.number("fp");
  counts.falseNegative = row.number("fn");
  counts.trueNegative = row.number("tn");
  const double samples = row.number("samples");
  for (const auto& [key, value] :
       {std::pair("tp", counts.truePositive), std::pair("fp", counts.falsePositive),
        std::pair("fn", counts.falseNegative), std::pair("tn", counts.trueNegative),
        std::pair("samples", samples)}) {
    if (!(value >= 0 && value < 1e15)) {
      row.fail(key, fmt::format("{} found, a count expected", value));
    }
  }
  counts.samples = static_cast<std::size_t>(samples);
  return counts;
}

study::BinRecord readBin(const JsonReader& row) {
  return {row.text("method"),      row.text("view"),         row.text("light"), row.text("axis"),
          row.numberOrNull("low"), row.numberOrNull("high"), readCounts(row)};
}

/// Summaries of older versions have none.
render::MethodMark readMark(const JsonReader& method) {
  if (!method.has("family")) return {};
  return {method.text("family"), method.text("symbol")};
}

/// Of any verdict, those of methods that answer alike are needed alone.
study::DifferenceRecord readDifference(const JsonReader& row) {
  study::DifferenceRecord difference;
  difference.view = row.text("view");
  difference.light = row.text("light");
  difference.first = row.text("first");
  difference.second = row.text("second");
  if (row.text("verdict") == differenceVerdictName(study::DifferenceVerdict::equal)) {
    difference.verdict = study::DifferenceVerdict::equal;
  }
  return difference;
}

/// What statistics over scenes need of a record: the drawn answers over all samples, which methods
/// answer alike, and the bins.
study::StudyRecord readRecord(const JsonReader& summary, const std::string& suite) {
  const JsonReader study = summary.object("study");
  study::StudyRecord record;
  record.name = study.text("name");
  record.title = study.text("title");
  record.reproduction.settings.insert("study", toml::table{{"suite", suite}});
  const JsonReader truth = summary.object("truth");
  record.truth.uncertainty = truth.number("uncertainty");
  for (const JsonReader& flip : truth.list("flips")) {
    record.truth.flips.push_back({flip.text("view"), flip.text("light"), flip.number("flip_rate")});
  }
  for (const JsonReader& method : summary.list("methods")) {
    record.methods.push_back({method.text("label"), method.text("name"), "", "", readMark(method)});
  }
  for (const JsonReader& row : summary.list("results")) {
    if (row.text("answer") != study::answerName(study::Answer::drawn) ||
        row.text("region") != study::wholeRegion) {
      continue;
    }
    record.results.push_back({row.text("method"), row.text("light"), row.text("view"),
                              std::string(study::wholeRegion), readCounts(row)});
    if (row.has("mae")) {  // under a light with a disc
      record.results.back().shares.push_back({"mae", row.numberOrNull("mae"), {}});
    }
  }
  for (const JsonReader& row : summary.list("differences")) {
    record.differences.push_back(readDifference(row));
  }
  for (const JsonReader& row : summary.list("bins")) record.bins.push_back(readBin(row));
  return record;
}

/// The scene of a summary; none where it is of no suite.
std::optional<FinishedScene> readScene(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  const Json json = readJson(file);
  const JsonReader summary(json, file.string(), "");
  if (summary.text("schema") != summarySchema) return std::nullopt;
  const JsonReader header = summary.object("study").object("settings").object("study");
  if (!header.has("suite")) return std::nullopt;
  return FinishedScene{folder, study::studyMeans(readRecord(summary, header.text("suite")))};
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
