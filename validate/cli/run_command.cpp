#include "cli/run_command.h"

#include <fmt/core.h>

#include <set>

#include "cli/plan_runs.h"
#include "cli/terminal_progress.h"
#include "common/memory.h"
#include "relief/table_file.h"
#include "report/terminal_ranking.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// All studies are read before the first is run: a typing error in the last one shows at once.
std::vector<StudyPlan> readPlans(const RunRequest& request) {
  std::vector<StudyPlan> plans;
  std::set<std::string> names;
  for (const fs::path& file : request.studies) {
    plans.push_back(readStudyPlan(file, request.options));
    requireNewName(names, file, plans.back().name);
  }
  return plans;
}

void bakeTables(const StudySpec& study, const fs::path& out) {
  TerminalProgress progress(study.name);
  const HeightField& field = study.relief.field;
  const HorizonTables tables = bakeHorizons(field, study.bake.settings,
                                            [&](double share) { progress.update("bake", share); });
  const StoredHorizons stored{tables.width,
                              tables.height,
                              tables.azimuths,
                              tables.radiusTexels,
                              tables.wrap,
                              storeTable(tables.horizon, study.bake.bits),
                              storeTable(tables.distance, study.bake.bits)};
  const fs::path path = out / study.name / "tables.exr";
  writeHorizons(path, stored);
  fmt::print("{}: {} × {} texels, {} azimuths, {} in {} bits\n", path.string(), tables.width,
             tables.height, tables.azimuths, formatBytes(static_cast<double>(stored.byteCount())),
             static_cast<int>(study.bake.bits));
}

}  // namespace

void requireNewName(std::set<std::string>& names, const fs::path& file, const std::string& name) {
  if (names.insert(name).second) return;
  throw InputError(fmt::format("{}: study.name: \"{}\" is the name of another study of this run",
                               file.string(), name));
}

ExitStatus runStudies(const RunRequest& request) {
  const std::vector<StudyPlan> plans = readPlans(request);
  requirePlots(plans);
  const GlContext gl;
  if (isRanking(plans)) removeRanking(request);
  Records records;
  std::vector<PlanRecords> parts;
  for (const StudyPlan& plan : plans) parts.push_back(runPlan(plan, gl, request, records));
  std::vector<StudyMeans> studies;
  for (const PlanRecords& part : parts) {
    StudyMeans means = finishPlan(part, request, records);
    printPlan(part, request, records);
    if (isRanked(*part.plan)) studies.push_back(std::move(means));
  }
  if (isRanking(plans)) {
    reportRanking(studies, request);
    fmt::print("{}\nReport: {}\n", rankingOverStudies(studies, coloursWanted()),
               (request.out / "ranking.html").string());
  }
  return ExitStatus::pass;
}

ExitStatus bakeStudies(const RunRequest& request) {
  for (const StudyPlan& plan : readPlans(request)) {
    for (const StudySpec& step : plan.steps) bakeTables(step, request.out);
  }
  return ExitStatus::pass;
}

}  // namespace gnomon
