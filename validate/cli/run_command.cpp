#include "cli/run_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "cli/terminal_progress.h"
#include "common/atomic_file.h"
#include "common/memory.h"
#include "relief/table_file.h"
#include "render/gl_context.h"
#include "report/folder_writer.h"
#include "report/metrics_csv.h"
#include "report/ranking_html.h"
#include "report/ranking_json.h"
#include "report/report_html.h"
#include "report/summary_json.h"
#include "report/terminal_ranking.h"
#include "report/terminal_table.h"
#include "study/claims.h"
#include "study/run_study.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// All studies are read before the first is run: a typing error in the last one shows at once.
std::vector<StudySpec> readStudies(const RunRequest& request) {
  std::vector<StudySpec> studies;
  std::set<std::string> names;
  for (const fs::path& file : request.studies) {
    studies.push_back(readStudy(file, request.options));
    if (!names.insert(studies.back().name).second) {
      throw InputError(
          fmt::format("{}: study.name: \"{}\" is the name of another study of this run",
                      file.string(), studies.back().name));
    }
    if (request.check && studies.back().thresholds.empty()) {
      throw InputError(
          fmt::format("{}: no [[threshold]], so there is nothing to check", file.string()));
    }
  }
  return studies;
}

void removeFiles(const fs::path& folder, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    std::error_code ignored;
    fs::remove(folder / name, ignored);
  }
}

StudyRecord runOne(const StudySpec& study, const GlContext& gl, const RunRequest& request) {
  const fs::path folder = request.out / study.name;
  // Older figures must not stand beside newer pictures.
  removeFiles(folder, {"summary.json", "metrics.csv", "report.html"});
  FolderWriter writer(folder);
  TerminalProgress progress(study.name);
  try {
    StudyRecord record = runStudy(study, gl, writer, [&](std::string_view stage, double share) {
      progress.update(stage, share);
    });
    record.command = request.command;
    return record;
  } catch (const Error& error) {
    // What fails inside a run speaks of keys or of the study's other files.
    throw Error(error.status(), fmt::format("{}: {}", study.file.string(), error.what()));
  }
}

/// Judges a study's claims by what the run holds so far, and writes its reports.
void report(const StudySpec& study, std::vector<StudyRecord>& records, std::size_t own,
            const fs::path& out) {
  StudyRecord& record = records[own];
  record.claims = judgeClaims(study.claims, records, own);
  const fs::path folder = out / record.name;
  writeTextAtomically(folder / "metrics.csv", metricsCsv(record));
  writeTextAtomically(folder / "report.html", reportHtml(record, folder));
  writeTextAtomically(folder / "summary.json", summaryJson(record));
}

/// Whether a claim of the study needs the record of another one, which may be run later.
bool speaksOfOthers(const StudySpec& study) {
  return std::any_of(study.claims.begin(), study.claims.end(),
                     [](const ClaimSpec& claim) { return !claim.gainExceeds.empty(); });
}

/// Ranks the methods over all studies, and prints and writes that.
void reportRanking(const std::vector<StudyRecord>& records, const RunRequest& request) {
  std::vector<StudyMeans> studies;
  for (const StudyRecord& record : records) studies.push_back(studyMeans(record));
  writeTextAtomically(request.out / "ranking.csv", rankingCsv(studies));
  writeTextAtomically(request.out / "ranking.html", rankingHtml(studies, request.command));
  writeTextAtomically(request.out / "ranking.json", rankingJson(studies, request.command));
  fmt::print("{}\nReport: {}\n", rankingOverStudies(studies, coloursWanted()),
             (request.out / "ranking.html").string());
}

}  // namespace

ExitStatus runStudies(const RunRequest& request) {
  const std::vector<StudySpec> studies = readStudies(request);
  const GlContext gl;
  const bool ranked = studies.size() > 1;
  if (ranked) removeFiles(request.out, {"ranking.json", "ranking.csv", "ranking.html"});
  std::vector<StudyRecord> records;
  for (const StudySpec& study : studies) {
    records.push_back(runOne(study, gl, request));
    // At once, so that a later study's failure leaves this one's report.
    report(study, records, records.size() - 1, request.out);
  }
  bool passed = true;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (speaksOfOthers(studies[i])) report(studies[i], records, i, request.out);
    passed = passed && records[i].passed();
    fmt::print("{}\nReport: {}\n\n", resultTable(records[i], coloursWanted()),
               (request.out / records[i].name / "report.html").string());
  }
  if (ranked) reportRanking(records, request);
  return request.check && !passed ? ExitStatus::thresholdFailed : ExitStatus::pass;
}

ExitStatus bakeStudies(const RunRequest& request) {
  for (const StudySpec& study : readStudies(request)) {
    TerminalProgress progress(study.name);
    const HeightField& field = study.relief.field;
    const HorizonTables tables = bakeHorizons(
        field, study.bake.settings, [&](double share) { progress.update("bake", share); });
    const StoredHorizons stored{tables.width,
                                tables.height,
                                tables.azimuths,
                                tables.radiusTexels,
                                tables.wrap,
                                storeTable(tables.horizon, study.bake.bits),
                                storeTable(tables.distance, study.bake.bits)};
    const fs::path path = request.out / study.name / "tables.exr";
    writeHorizons(path, stored);
    fmt::print("{}: {} × {} texels, {} azimuths, {} in {} bits\n", path.string(), tables.width,
               tables.height, tables.azimuths, formatBytes(static_cast<double>(stored.byteCount())),
               static_cast<int>(study.bake.bits));
  }
  return ExitStatus::pass;
}

}  // namespace gnomon
