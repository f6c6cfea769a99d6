#include "cli/commands/rank_command.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <system_error>

#include "cli/commands/run_command.h"
#include "cli/output.h"
#include "common/lists.h"
#include "compare/scenes/resampled_mean.h"
#include "render/method.h"
#include "render/shader_files.h"
#include "report/json/json_values.h"
#include "report/json/results_json.h"
#include "report/run_folder.h"
#include "report/suite/entry_report.h"
#include "report/suite/suite_files.h"
#include "report/terminal_page.h"
#include "study/judge/suite/standings.h"
#include "study/spec/suite/drawn_suite.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

constexpr const char* rankExamples = R"(
Errors of all other methods are the committed ones: only yours are measured, and `unshadowed`, whose
error has to be the committed one. A page for others is DIR/suite.html.

Examples:
  gnomon rank my-shadow.glsl                     # 24 scenes, a minute or two
  gnomon rank my-shadow.glsl --scenes 200
  gnomon rank my-shadow.glsl --suite suite-2     # under suns
  gnomon rank --masks theirs                     # theirs/suite-1-test-0001/VIEW_LIGHT.png, …)";

const report::FolderKind rankKind{
    "suite.json", {"suite.csv", "suite.md", "suite.html"}, "rank.txt", true};

/// What is measured beside the control.
struct Entries {
  study::SuiteMethods methods;  ///< the control first
  std::vector<std::string> labels;
};

/// A label that no committed entry has.
std::string ownLabel(const std::string& name, const std::set<std::string>& committed) {
  return committed.contains(name) ? name + " (yours)" : name;
}

Entries entriesOf(const RankRequest& request, const study::Standings& standings) {
  std::set<std::string> committed;
  for (const study::StudyMeans& scene : standings.means) {
    for (const study::MethodMeans& method : scene.methods) committed.insert(method.label);
  }
  Entries entries;
  if (request.methods) entries.methods = study::readSuiteMethods(*request.methods, {});
  auto& list = entries.methods.methods;
  const auto name = [&](const std::string& label) {
    entries.labels.push_back(ownLabel(label, committed));
    return entries.labels.back();
  };
  const auto noteCamera = [&](const std::string& shader, const fs::path& file) {
    if (render::readMethod(file).needsCamera()) entries.methods.ofCameras.insert(shader);
  };
  for (toml::table& method : list) {
    method.insert_or_assign("label", name(study::labelOfMethod(method)));
    if (const auto file = method["file"].value<std::string>()) {
      const fs::path there = fs::absolute(request.methods->parent_path() / *file);
      method.insert_or_assign("file", there.string());
      noteCamera(there.string(), there);
    } else if (const auto own = method["name"].value<std::string>()) {
      noteCamera(*own, render::methodFile(render::shaderFolder(), *own));
    }
  }
  for (const fs::path& shader : request.shaders) {
    const fs::path there = fs::absolute(shader);
    list.push_back(toml::table{{"file", there.string()}, {"label", name(shader.stem().string())}});
    noteCamera(there.string(), there);
  }
  for (const fs::path& masks : request.masks) {
    name((masks / "").lexically_normal().parent_path().filename().string());
  }
  list.insert(list.begin(), toml::table{{"name", study::control}});
  std::set<std::string> seen;
  for (const std::string& label : entries.labels) {
    if (!seen.insert(label).second) {
      throw InputError(fmt::format("two entries \"{}\" found, labels that differ expected", label));
    }
  }
  return entries;
}

/// The first scenes of the suite with the control and the entries as their methods.
study::DrawnSuite drawScenes(const RankRequest& request, const study::Standings& standings,
                             const Entries& entries) {
  const fs::path file = study::standardSuiteFile().parent_path() / (request.suite + ".toml");
  study::DrawnSuite drawn =
      study::drawSuite(study::readSuite(file), entries.methods, study::SuiteSplit::test,
                       standings.seed, standings.scenes);
  if (drawn.sha256 != standings.sha256) {
    throw InputError(
        fmt::format("{}: scenes {} found, the committed {} expected: these scenes are "
                    "not those of the committed errors",
                    file.string(), drawn.sha256, standings.sha256));
  }
  drawn.studies.resize(std::min(drawn.studies.size(), static_cast<std::size_t>(request.scenes)));
  const std::size_t firstMasks = entries.labels.size() - request.masks.size();
  for (study::SuiteStudy& study : drawn.studies) {
    for (std::size_t i = 0; i < request.masks.size(); ++i) {
      const fs::path masks = fs::absolute(request.masks[i]) / fs::path(study.file).stem();
      toml::table rest;
      rest.insert("method", toml::array{toml::table{{"label", entries.labels[firstMasks + i]},
                                                    {"masks", masks.string()}}});
      study.text += "\n" + study::suiteText(rest, {"method"});
    }
  }
  return drawn;
}

/// Removes the files that the manifest of an earlier call names, and no others.
void removeScenes(const fs::path& folder) {
  std::error_code failure;
  const fs::path file = folder / "manifest.json";
  if (!fs::exists(file, failure)) return;
  const report::Json json = report::readJson(file);
  const report::JsonReader manifest(json, file.string(), "");
  for (const char* list : {"studies", "files"}) {
    for (const report::JsonReader& entry : manifest.list(list)) {
      const fs::path name = fs::path(entry.text("file")).lexically_normal();
      if (name.is_absolute() || *name.begin() == "..") continue;
      fs::remove(folder / name, failure);
      fs::remove((folder / name).parent_path(), failure);  // where nothing else is in it
    }
  }
  fs::remove(file, failure);
}

/// Writes the scenes in the place of those of an earlier call.
void writeScenes(const study::DrawnSuite& drawn, const fs::path& folder) {
  removeScenes(folder);
  study::writeSuite(drawn, report::suiteManifest(drawn), folder);
}

/// Measures scenes: figures alone, or whole reports.
void measure(const RankRequest& request, const std::vector<fs::path>& scenes, const fs::path& out,
             bool figuresAlone) {
  RunRequest run;
  run.studies = scenes;
  run.out = out;
  run.options.overrides = {"study.frames=0"};
  run.noCache = request.noCache;
  run.metricsOnly = figuresAlone;
  run.isQuiet = true;
  run.command = request.command;
  const ExitStatus status = runStudies(run);
  if (status != ExitStatus::pass) {
    throw Error(status, "not every scene could be measured, so there is no rank");
  }
}

std::vector<study::StudyMeans> measuredScenes(const fs::path& folder,
                                              const study::DrawnSuite& drawn) {
  std::set<std::string> names;
  for (const study::SuiteStudy& study : drawn.studies) {
    names.insert(fs::path(study.file).stem().string());
  }
  std::vector<study::StudyMeans> means;
  for (report::FinishedScene& scene : report::readFinishedScenes(folder)) {
    if (names.contains(scene.means.name)) means.push_back(std::move(scene.means));
  }
  return means;
}

/// What a scene is beside what its title says.
std::vector<std::string> familiesOf(const toml::table& facts) {
  const double elevation = facts["elevation"].value_or(0.0);
  return {elevation < 15   ? "light below 15°"
          : elevation < 30 ? "light at 15 to 30°"
                           : "light above 30°",
          facts["view"].value_or<std::string>("") + " view"};
}

report::SceneFamilies familiesOf(const study::DrawnSuite& drawn) {
  report::SceneFamilies families;
  for (const study::SuiteStudy& study : drawn.studies) {
    families[fs::path(study.file).stem().string()] = familiesOf(study.facts);
  }
  return families;
}

void printEntry(const report::EntryReport& entry) {
  printLine(entry.place);
  printLine(entry.against);
  for (const report::Table* table : {&entry.neighbours, &entry.families, &entry.worst}) {
    printText("\n" + report::terminalTable(*table));
  }
  printText("\n");
}

}  // namespace

CLI::App* addRankCommand(CLI::App& app, RankRequest& request) {
  CLI::App* command = app.add_subcommand("rank", "Rank a shader among all published methods");
  command->add_option("SHADER", request.shaders, "GLSL files, each an entry")->type_name("FILE…");
  command
      ->add_option("--masks", request.masks,
                   "Also an entry: a folder with a subfolder of masks for each scene, drawn by "
                   "another renderer for the exported samples; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("DIR");
  command
      ->add_option("--methods", request.methods,
                   "Also entries: [[method]] tables with settings, as scenes/suite/methods.toml")
      ->type_name("FILE");
  command->add_option("--suite", request.suite, "Whose test scenes")
      ->capture_default_str()
      ->type_name("SUITE");
  command->add_option("--scenes", request.scenes, "How many of them, from the first")
      ->check(CLI::Range(static_cast<int>(compare::leastScenes), 9999))
      ->capture_default_str()
      ->type_name("N");
  command->add_option("--out", request.out, "Folder for scenes, figures and the page")
      ->capture_default_str()
      ->type_name("DIR");
  command->add_flag("--no-cache", request.noCache, "Do not use the result cache");
  addPaperOptions(*command, request.paper);
  command->footer(rankExamples);
  return command;
}

ExitStatus rankEntries(const RankRequest& request) {
  if (request.shaders.empty() && request.masks.empty() && !request.methods) {
    throw UsageError("rank: a GLSL file, --masks or --methods expected. See gnomon rank --help");
  }
  const study::Standings standings = study::readStandings(study::standingsFolder(), request.suite);
  const Entries entries = entriesOf(request, standings);
  requirePaperMethods(request.paper, entries.labels);
  const study::DrawnSuite drawn = drawScenes(request, standings, entries);
  report::RunFolder folder(request.out, rankKind);
  writeScenes(drawn, request.out / "scenes");
  std::vector<fs::path> files;
  for (const study::SuiteStudy& study : drawn.studies) {
    files.push_back(request.out / "scenes" / study.file);
  }
  measure(request, files, request.out / "results", true);
  const std::vector<study::StudyMeans> scenes =
      study::joined(standings, measuredScenes(request.out / "results", drawn), entries.labels);
  study::SuiteStatistics statistics =
      study::suiteStatistics(scenes.front().suite, scenes, entries.labels);

  std::vector<fs::path> worst;
  std::set<std::string> shown;
  for (const std::string& entry : entries.labels) {
    for (const std::string& name : report::worstScenes(statistics, entry)) {
      if (shown.insert(name).second) worst.push_back(request.out / "scenes" / (name + ".toml"));
    }
  }
  measure(request, worst, request.out / "worst", false);
  for (study::SuiteScene& scene : statistics.scenes) {
    if (shown.contains(scene.name)) scene.report = "worst/" + scene.name + "/report.html";
  }
  folder.clear();
  std::vector<report::EntryReport> reports;
  std::vector<report::PageSection> opening;
  for (const std::string& entry : entries.labels) {
    reports.push_back(report::entryReport(statistics, entry, familiesOf(drawn)));
    opening.push_back(report::entrySection(reports.back()));
  }
  report::writeSuiteFiles(statistics, scenes, request.command, request.paper, folder, opening);
  folder.finish(report::suiteJson(statistics, request.command));
  printLine(fmt::format("{}: {} of {} scenes; errors of other methods are the committed ones\n",
                        request.suite, scenes.size(), standings.scenes));
  for (const report::EntryReport& entry : reports) printEntry(entry);
  printLine("Report: " + (request.out / "suite.html").string());
  return ExitStatus::pass;
}

}  // namespace gnomon::cli
