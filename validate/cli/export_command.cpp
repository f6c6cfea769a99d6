#include "cli/export_command.h"

#include <fmt/core.h>

#include <memory>

#include "cli/cache_command.h"
#include "cli/study_plans.h"
#include "cli/terminal_progress.h"
#include "common/atomic_file.h"
#include "report/export_files.h"
#include "report/export_json.h"
#include "report/mesh_files.h"
#include "report/number_text.h"
#include "report/refinement_text.h"
#include "report/truth_files.h"
#include "study/truth_study.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// Older files must not pass for a part of what is written now.
void removeFile(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

/// Calls `work(study, gl, clock, cache)` for every step of every study.
template <typename Work>
ExitStatus forEachStudy(const RunRequest& request, const Work& work) {
  const std::vector<StudyPlan> plans = readPlans(request.studies, request.options);
  const GlContext gl;
  const std::unique_ptr<Cache> cache = openCache(request.noCache);
  for (const StudyPlan& plan : plans) {
    for (const StudySpec& study : plan.steps) {
      TerminalProgress progress(study.name);
      StageClock clock(
          [&](std::string_view stage, double share) { progress.update(stage, share); });
      inStudy(study, [&] { work(study, gl, clock, *cache); });
    }
  }
  return ExitStatus::pass;
}

void printNotices(const StudyRecord& record) {
  for (const std::string& notice : record.notices) fmt::print("Notice: {}\n", notice);
}

void traceOne(const StudySpec& study, const GlContext& gl, StageClock& clock, Cache& cache,
              const RunRequest& request) {
  const fs::path folder = request.out / study.name / "truth";
  removeFile(folder / "truth.json");
  RunScene scene(study, clock, gl, cache);
  StudyRecord record = traceStudy(scene, gl);
  record.command = request.command;
  writeTruth(folder, scene, record);
  fmt::print("{}: {} views, {} lights, {} micro-triangles, uncertain by at most {} %\n",
             (folder / "truth.json").string(), study.views.size(), study.lights.size(),
             groupedText(record.truth.microTriangles), percentText(record.truth.uncertainty));
  if (record.truth.wantedUncertainty) fmt::print("{}\n", refinementText(record.truth));
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
  const int pieces = scene.study.baseSubdivisions;
  writeObj(path, scene.standardBase().drawn.get().mesh, scene.study.relief.texelsPerUv(),
           fmt::format("base mesh, {} x {} pieces a face", pieces, pieces));
}

void exportOne(const StudySpec& study, const GlContext& gl, StageClock& clock, Cache& cache,
               const RunRequest& request, std::optional<int> subdivisions) {
  const fs::path folder = request.out / study.name / "export";
  removeFile(folder / "export.json");
  RunScene scene(study, clock, gl, cache);
  const ExportedMesh mesh = clock.measure("meshes", [&](const Progress&) {
    return writeDisplaced(folder / "displaced.ply", scene, subdivisions);
  });
  writeBase(folder / "base.obj", scene);
  writeHeights(folder, study.relief.field);
  const StoredHorizons tables = clock.measure(
      "bake", [&](const Progress& progress) { return bakeStudyTables(study, cache, progress); });
  writeHorizons(folder / "tables.exr", tables);
  double rayLift = 0;
  StudyRecord record = traceStudy(scene, gl, [&](const TracedSurface& surface) {
    rayLift = standardLift * surface.mesh.extent();
    writeSampleMaps(folder, scene, surface.mesh);
  });
  record.command = request.command;
  writeTruthMasks(folder, scene);
  writeRegionsOfInterest(folder, scene);
  writeTextAtomically(folder / "export.json", exportJson(scene, record, mesh, tables, rayLift));
  fmt::print("{}: {} triangles displaced ({} pieces a face's side), {} views, {} lights\n",
             (folder / "export.json").string(), groupedText(mesh.triangles), mesh.subdivisions,
             study.views.size(), study.lights.size());
  printNotices(record);
}

}  // namespace

ExitStatus traceStudies(const RunRequest& request) {
  return forEachStudy(request, [&](const StudySpec& study, const GlContext& gl, StageClock& clock,
                                   Cache& cache) { traceOne(study, gl, clock, cache, request); });
}

ExitStatus exportStudies(const RunRequest& request, std::optional<int> subdivisions) {
  return forEachStudy(
      request, [&](const StudySpec& study, const GlContext& gl, StageClock& clock, Cache& cache) {
        exportOne(study, gl, clock, cache, request, subdivisions);
      });
}

}  // namespace gnomon
