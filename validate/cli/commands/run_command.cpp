#include "cli/commands/run_command.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <map>
#include <memory>

#include "cli/commands/cache_command.h"
#include "cli/output.h"
#include "cli/study_plans.h"
#include "common/files/atomic_file.h"
#include "common/lists.h"
#include "common/system/memory.h"
#include "export/export_json.h"
#include "export/mesh_files.h"
#include "export/truth_files.h"
#include "horizon/stored_table.h"
#include "report/paper_files.h"
#include "report/text/number_text.h"
#include "study/run/run_study.h"

namespace gnomon::cli {

namespace fs = std::filesystem;
namespace {

void bakeTables(const study::StudySpec& study, const fs::path& out, cache::Cache& cache) {
  TerminalProgress progress(study.name);
  const horizon::StoredHorizons stored =
      study::bakeStudyTables(study, cache, [&](double share) { progress.update("bake", share); });
  const fs::path file = out / study.name / "tables.exr";
  removeLeftovers(file.parent_path());
  horizon::writeHorizons(file, stored);
  printLine(fmt::format("{}: {} × {} texels, {} azimuths, {} in {} bits", file.string(),
                        stored.width, stored.height, stored.layers,
                        formatBytes(static_cast<double>(stored.byteCount())),
                        static_cast<int>(study.bake.bits)));
}

}  // namespace

ExitStatus runStudies(const RunRequest& request) {
  if (request.shard) return runShard(request);
  const std::vector<study::StudyPlan> plans = readPlans(request.studies, request.options);
  requirePaperMethods(request.paper, plans);
  Failures failures;
  return measurePlans(plans, request, failures);
}

ExitStatus bakeStudies(const RunRequest& request) {
  const std::vector<study::StudyPlan> plans = readPlans(request.studies, request.options);
  const std::unique_ptr<cache::Cache> cache = openCache(request.noCache);
  Failures failures;
  for (const study::StudyPlan& plan : plans) {
    for (const study::StudySpec& step : plan.steps) {
      failures.attempt([&] { bakeTables(step, request.out, *cache); });
    }
  }
  failures.print();
  return failures.status();
}

CLI::Option* addPaperOptions(CLI::App& command, report::PaperOptions& options) {
  const std::map<std::string, report::PaperWidth> widths = {{"column", report::PaperWidth::column},
                                                            {"page", report::PaperWidth::page}};
  CLI::Option* figures =
      command
          .add_option("--figures", options.widths,
                      "Also write figures for a paper, as PDF: as wide as a column, 84 mm, "
                      "or a page, 178 mm; of a page its table too. May be repeated")
          ->transform(CLI::CheckedTransformer(widths).description(""))
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
          ->type_name("column|page");
  addList(command, "--paper-method", options.methods,
          "Show only this method, by its label, in the figures and tables for a paper; may be "
          "repeated",
          "LABEL");
  command
      .add_option("--paper-font", options.fontSize,
                  "Size of the text in the figures and tables for a paper, points")
      ->capture_default_str()
      ->check(CLI::Range(5.0, 14.0))
      ->type_name("SIZE");
  const std::vector<std::string> columns = report::paperColumnKeys();
  addList(command, "--table-column", options.columns,
          fmt::format("Show only this column beside the method in the tables for a paper; may be "
                      "repeated: {}",
                      fmt::join(columns, ", ")),
          "KEY")
      ->check(CLI::IsMember(columns).description(""));
  return figures;
}

void appendLabels(const study::StudyPlan& plan, std::vector<std::string>& labels) {
  for (const study::StudySpec& step : plan.steps) {
    for (const study::MethodSpec& method : step.methods) appendOnce(labels, method.label);
  }
}

void requirePaperMethods(const report::PaperOptions& options,
                         const std::vector<study::StudyPlan>& plans) {
  std::vector<std::string> labels;
  for (const study::StudyPlan& plan : plans) appendLabels(plan, labels);
  requirePaperMethods(options, labels);
}

void requirePaperMethods(const report::PaperOptions& options,
                         const std::vector<std::string>& measured) {
  for (const std::string& label : options.methods) {
    if (contains(measured, label)) continue;
    throw UsageError(
        fmt::format("--paper-method: \"{}\" found, a method that is measured expected: {}", label,
                    fmt::join(measured, ", ")));
  }
}

namespace {

/// Claims `out/NAME/SUBFOLDER` of every step, then begins them all.
std::vector<report::RunFolder> claimFolders(const std::vector<study::StudyPlan>& plans,
                                            const fs::path& out, const std::string& subfolder) {
  const report::FolderKind kind{subfolder + ".json"};
  std::vector<report::RunFolder> folders;
  for (const study::StudyPlan& plan : plans) {
    for (const study::StudySpec& study : plan.steps) {
      folders.emplace_back(out / study.name / subfolder, kind);
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

Exported writeDisplaced(const fs::path& file, const study::RunScene& scene,
                        std::optional<int> subdivisions) {
  const int pieces = subdivisions.value_or(
      displaced::subdivisionsForTexels(scene.surface, scene.study.relief.texelsPerUv()));
  displaced::WeldedMesh mesh = displaced::makeWeldedMesh(scene.surface, scene.study.relief, pieces);
  exporting::writePly(file, mesh,
                      fmt::format("displaced surface, {} x {} pieces a face", pieces, pieces));
  const exporting::ExportedMesh about{pieces, mesh.vertices.size(), mesh.triangleCount(),
                                      mesh.closed};
  return {std::move(mesh), about};
}

void writeBase(const fs::path& file, study::RunScene& scene) {
  const int pieces = scene.study.base.subdivisions;
  exporting::writeObj(file, scene.standardBase().drawn.get()->mesh,
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
