#include "cli/commands/export_command.h"

#include <fmt/core.h>

#include <memory>

#include "cli/commands/cache_command.h"
#include "cli/output.h"
#include "cli/run_folders.h"
#include "cli/study_plans.h"
#include "export/export_json.h"
#include "export/mesh_files.h"
#include "export/truth_files.h"
#include "report/text/number_text.h"
#include "study/run/run_study.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

/// Claims `out/NAME/SUBFOLDER` of every step, then begins them all.
std::vector<report::RunFolder> claimFolders(const std::vector<study::StudyPlan>& plans,
                                            const fs::path& out, const std::string& subfolder) {
  const report::FolderKind kind{subfolder + ".json"};
  std::vector<report::RunFolder> folders;
  for (const study::StudyPlan& plan : plans) {
    for (const study::StudySpec& study : plan.steps) {
      const fs::path path = out / study.name / subfolder;
      folders.emplace_back(path, kind);
      folders.back().requireNone(inputsBeside(plan));
    }
  }
  for (report::RunFolder& folder : folders) folder.clear();
  return folders;
}

/// Calls `work(study, folder, gl, clock, cache)` for every step of every study, whatever becomes of
/// one.
template <typename Work>
ExitStatus forEachStudy(const RunRequest& request, const std::string& subfolder, const Work& work) {
  const std::vector<study::StudyPlan> plans = readPlans(request.studies, request.options);
  const render::GlContext gl;
  std::vector<report::RunFolder> folders = claimFolders(plans, request.out, subfolder);
  auto next = folders.begin();
  const std::unique_ptr<cache::Cache> cache = openCache(request.noCache);
  Failures failures;
  for (const study::StudyPlan& plan : plans) {
    for (const study::StudySpec& study : plan.steps) {
      report::RunFolder& folder = *next++;
      failures.attempt([&] {
        TerminalProgress progress(study.name);
        study::StageClock clock(
            [&](std::string_view stage, double share) { progress.update(stage, share); });
        inStudy(study, [&] { work(study, folder, gl, clock, *cache); });
      });
    }
  }
  failures.print();
  return failures.status();
}

void printNotices(const study::StudyRecord& record) {
  for (const std::string& notice : record.notices) printLine("Notice: " + notice);
}

void traceOne(const study::StudySpec& study, report::RunFolder& folder, const render::GlContext& gl,
              study::StageClock& clock, cache::Cache& cache, const RunRequest& request) {
  study::RunScene scene(study, clock, gl, cache);
  study::StudyRecord record = study::traceStudy(scene, gl);
  record.command = request.command;
  exporting::writeTruth(folder, scene, record);
  printLine(fmt::format("{}: {} views, {} lights, {} micro-triangles, uncertain by at most {} %",
                        (folder.place() / "truth.json").string(), study.views.size(),
                        study.lights.size(), report::groupedText(record.truth.microTriangles),
                        report::percentText(record.truth.uncertainty)));
  printNotices(record);
}

/// The exported mesh, and what is said of it.
struct Exported {
  displaced::WeldedMesh mesh;
  exporting::ExportedMesh about;
};

Exported writeDisplaced(const fs::path& path, const study::RunScene& scene,
                        std::optional<int> subdivisions) {
  const int pieces = subdivisions.value_or(
      displaced::subdivisionsForTexels(scene.surface, scene.study.relief.texelsPerUv()));
  displaced::WeldedMesh mesh = displaced::makeWeldedMesh(scene.surface, scene.study.relief, pieces);
  exporting::writePly(path, mesh,
                      fmt::format("displaced surface, {} x {} pieces a face", pieces, pieces));
  const exporting::ExportedMesh about{pieces, mesh.vertices.size(), mesh.triangleCount(),
                                      mesh.closed};
  return {std::move(mesh), about};
}

void writeBase(const fs::path& path, study::RunScene& scene) {
  const int pieces = scene.study.base.subdivisions;
  exporting::writeObj(path, scene.standardBase().drawn.get()->mesh,
                      scene.study.relief.texelsPerUv(),
                      fmt::format("base mesh, {} x {} pieces a face", pieces, pieces));
}

void exportOne(const study::StudySpec& study, report::RunFolder& folder,
               const render::GlContext& gl, study::StageClock& clock, cache::Cache& cache,
               const RunRequest& request, std::optional<int> subdivisions) {
  study::RunScene scene(study, clock, gl, cache);
  Exported exported = clock.measure("meshes", [&](const Progress&) {
    return writeDisplaced(folder.newFile("displaced.ply"), scene, subdivisions);
  });
  writeBase(folder.newFile("base.obj"), scene);
  exporting::writeHeights(folder, study.relief.field);
  const horizon::StoredHorizons tables = clock.measure("bake", [&](const Progress& progress) {
    return study::bakeStudyTables(study, cache, progress);
  });
  horizon::writeHorizons(folder.newFile("tables.exr"), tables);
  double rayLift = 0;
  exporting::DrawnTruths drawn;
  std::vector<std::vector<double>> uncertainties;
  study::StudyRecord record = study::traceStudy(
      scene, gl,
      [&](const study::TracedSurface& surface) {
        rayLift = surface.mesh.rayOffset();
        exporting::writeSampleMaps(folder, scene, surface.mesh);
        exported.about.distance = exporting::meshDistance(scene, surface.mesh, exported.mesh,
                                                          exported.about.subdivisions);
        drawn = exporting::writeDrawnMesh(folder, scene, surface);
      },
      [&](const study::TracedSurface& coarse) {
        uncertainties = exporting::drawnUncertainties(scene, coarse, drawn);
      });
  record.command = request.command;
  exporting::writeTruthMasks(folder, scene);
  exporting::writeRegionsOfInterest(folder, scene);
  const exporting::ExportedMesh& mesh = exported.about;
  folder.finish(exporting::exportJson(scene, record, mesh, tables, rayLift, uncertainties));
  printLine(fmt::format(
      "{}: {} triangles displaced ({} pieces a face's side, at most {:.2g} "
      "texels off the truth's surface), {} views, {} lights",
      (folder.place() / "export.json").string(), report::groupedText(mesh.triangles),
      mesh.subdivisions, mesh.distance.largestTexels, study.views.size(), study.lights.size()));
  printNotices(record);
}

}  // namespace

ExitStatus traceStudies(const RunRequest& request) {
  return forEachStudy(
      request, "truth",
      [&](const study::StudySpec& study, report::RunFolder& folder, const render::GlContext& gl,
          study::StageClock& clock,
          cache::Cache& cache) { traceOne(study, folder, gl, clock, cache, request); });
}

ExitStatus exportStudies(const RunRequest& request, std::optional<int> subdivisions) {
  return forEachStudy(
      request, "export",
      [&](const study::StudySpec& study, report::RunFolder& folder, const render::GlContext& gl,
          study::StageClock& clock, cache::Cache& cache) {
        exportOne(study, folder, gl, clock, cache, request, subdivisions);
      });
}

}  // namespace gnomon::cli
