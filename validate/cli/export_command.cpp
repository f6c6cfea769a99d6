#include "cli/export_command.h"

#include <fmt/core.h>

#include <memory>

#include "cli/cache_command.h"
#include "cli/failure.h"
#include "cli/output.h"
#include "cli/run_folders.h"
#include "cli/study_plans.h"
#include "cli/terminal_progress.h"
#include "export/export_files.h"
#include "export/export_json.h"
#include "export/mesh_files.h"
#include "export/truth_files.h"
#include "report/text/number_text.h"
#include "report/text/refinement_text.h"
#include "study/run/truth_study.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// The folder of one step, locked.
struct StepFolder {
  RunFolder folder;
  FileLock lock;
};

/// Locks `out/NAME/SUBFOLDER` of every step, then removes what an earlier command left in them.
std::vector<StepFolder> claimFolders(const std::vector<StudyPlan>& plans, const fs::path& out,
                                     const std::string& subfolder) {
  const FolderKind kind{subfolder + ".json"};
  std::vector<StepFolder> steps;
  for (const StudyPlan& plan : plans) {
    for (const StudySpec& study : plan.steps) {
      const fs::path path = out / study.name / subfolder;
      FileLock lock = lockFolder(RunFolder(path, kind));
      steps.push_back({RunFolder(path, kind), std::move(lock)});
    }
  }
  for (StepFolder& step : steps) step.folder.removeIndex();
  for (StepFolder& step : steps) step.folder.clear();
  return steps;
}

/// Calls `work(study, folder, gl, clock, cache)` for every step of every study, whatever becomes of
/// one.
template <typename Work>
ExitStatus forEachStudy(const RunRequest& request, const std::string& subfolder, const Work& work) {
  const std::vector<StudyPlan> plans = readPlans(request.studies, request.options);
  const GlContext gl;
  std::vector<StepFolder> folders = claimFolders(plans, request.out, subfolder);
  auto next = folders.begin();
  const std::unique_ptr<Cache> cache = openCache(request.noCache);
  Failures failures;
  for (const StudyPlan& plan : plans) {
    for (const StudySpec& study : plan.steps) {
      RunFolder& folder = (next++)->folder;
      failures.attempt([&] {
        TerminalProgress progress(study.name);
        StageClock clock(
            [&](std::string_view stage, double share) { progress.update(stage, share); });
        inStudy(study, [&] { work(study, folder, gl, clock, *cache); });
      });
    }
  }
  failures.print();
  return failures.status();
}

void printNotices(const StudyRecord& record) {
  for (const std::string& notice : record.notices) printLine("Notice: " + notice);
}

void traceOne(const StudySpec& study, RunFolder& folder, const GlContext& gl, StageClock& clock,
              Cache& cache, const RunRequest& request) {
  SceneStore store;
  RunScene scene(study, clock, gl, cache, store);
  StudyRecord record = traceStudy(scene, gl);
  record.command = request.command;
  writeTruth(folder, scene, record);
  printLine(fmt::format("{}: {} views, {} lights, {} micro-triangles, uncertain by at most {} %",
                        (folder.path() / "truth.json").string(), study.views.size(),
                        study.lights.size(), groupedText(record.truth.microTriangles),
                        percentText(record.truth.uncertainty)));
  if (record.truth.wantedUncertainty) printLine(refinementText(record.truth));
  printNotices(record);
}

ExportedMesh writeDisplaced(const fs::path& path, const RunScene& scene,
                            std::optional<int> subdivisions) {
  const int pieces =
      subdivisions.value_or(subdivisionsForTexels(scene.surface, scene.study.relief.texelsPerUv()));
  const WeldedMesh mesh = makeWeldedMesh(scene.surface, scene.study.relief, pieces);
  writePly(path, mesh, fmt::format("displaced surface, {} x {} pieces a face", pieces, pieces));
  return {pieces, mesh.vertices.size(), mesh.triangleCount(), mesh.closed};
}

void writeBase(const fs::path& path, RunScene& scene) {
  const int pieces = scene.study.base.subdivisions;
  writeObj(path, scene.standardBase().drawn.get()->mesh, scene.study.relief.texelsPerUv(),
           fmt::format("base mesh, {} x {} pieces a face", pieces, pieces));
}

void exportOne(const StudySpec& study, RunFolder& folder, const GlContext& gl, StageClock& clock,
               Cache& cache, const RunRequest& request, std::optional<int> subdivisions) {
  SceneStore store;
  RunScene scene(study, clock, gl, cache, store);
  const ExportedMesh mesh = clock.measure("meshes", [&](const Progress&) {
    return writeDisplaced(folder.newFile("displaced.ply"), scene, subdivisions);
  });
  writeBase(folder.newFile("base.obj"), scene);
  writeHeights(folder, study.relief.field);
  const StoredHorizons tables = clock.measure(
      "bake", [&](const Progress& progress) { return bakeStudyTables(study, cache, progress); });
  writeHorizons(folder.newFile("tables.exr"), tables);
  double rayLift = 0;
  StudyRecord record = traceStudy(scene, gl, [&](const TracedSurface& surface) {
    rayLift = surface.mesh.rayOffset();
    writeSampleMaps(folder, scene, surface.mesh);
  });
  record.command = request.command;
  writeTruthMasks(folder, scene);
  writeRegionsOfInterest(folder, scene);
  folder.finish(exportJson(scene, record, mesh, tables, rayLift));
  printLine(fmt::format("{}: {} triangles displaced ({} pieces a face's side), {} views, {} lights",
                        (folder.path() / "export.json").string(), groupedText(mesh.triangles),
                        mesh.subdivisions, study.views.size(), study.lights.size()));
  printNotices(record);
}

}  // namespace

ExitStatus traceStudies(const RunRequest& request) {
  return forEachStudy(
      request, "truth",
      [&](const StudySpec& study, RunFolder& folder, const GlContext& gl, StageClock& clock,
          Cache& cache) { traceOne(study, folder, gl, clock, cache, request); });
}

ExitStatus exportStudies(const RunRequest& request, std::optional<int> subdivisions) {
  return forEachStudy(
      request, "export",
      [&](const StudySpec& study, RunFolder& folder, const GlContext& gl, StageClock& clock,
          Cache& cache) { exportOne(study, folder, gl, clock, cache, request, subdivisions); });
}

}  // namespace gnomon
