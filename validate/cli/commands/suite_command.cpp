#include "cli/commands/suite_command.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <map>
#include <set>
#include <system_error>

#include "cli/commands/run_command.h"
#include "cli/output.h"
#include "cli/study_plans.h"
#include "common/files/atomic_file.h"
#include "compare/scenes/resampled_mean.h"
#include "report/json/results_json.h"
#include "report/suite/suite_files.h"
#include "report/terminal_page.h"
#include "study/judge/suite/chosen_settings.h"
#include "study/spec/suite/drawn_suite.h"

namespace gnomon::cli {

namespace {

constexpr const char* examples = R"text(
The same seed gives the same bytes on every machine. Prints the SHA-256 of all scenes: docs/suite.md
lists it for the public seeds, and whoever keeps a seed hidden publishes it in advance.

Examples:
  gnomon suite --seed 1 --scenes 200 --split test --out suite
  gnomon run suite/*.toml --out results
  gnomon suite --seed "$(openssl rand -hex 16)"     # prints the SHA-256 alone)text";

}  // namespace

CLI::App* addSuiteCommand(CLI::App& app, SuiteRequest& request) {
  CLI::App* suite = app.add_subcommand("suite", "Draw the studies of a suite from a seed");
  suite->add_option("--seed", request.seed, "Any text; scenes depend on it alone")
      ->required()
      ->type_name("TEXT");
  suite->add_option("--scenes", request.scenes, "Number of scenes")
      ->check(CLI::Range(1, 9999))
      ->capture_default_str()
      ->type_name("N");
  suite
      ->add_option("--split", request.split,
                   "`train`, where settings are chosen, or `test`, where methods are ranked")
      ->check(CLI::IsMember({"train", "test"}))
      ->capture_default_str()
      ->type_name("SPLIT");
  suite->add_option("--out", request.out, "New folder for the studies, their files and a manifest")
      ->type_name("DIR");
  suite
      ->add_option("--from", request.from, "The suite's file; scenes/suite/suite-1.toml by default")
      ->type_name("FILE");
  suite
      ->add_option("--methods", request.methods,
                   "The methods of every study; scenes/suite/methods.toml by default")
      ->type_name("FILE");
  suite
      ->add_option("--settings", request.settings,
                   "Settings that were chosen on train: [[method]] tables that the studies of test "
                   "get beside the authors' own")
      ->type_name("FILE");
  suite->footer(examples);
  return suite;
}

ExitStatus drawSuiteScenes(const SuiteRequest& request) {
  const study::SuiteSpec suite =
      study::readSuite(request.from.value_or(study::standardSuiteFile()));
  const study::SuiteMethods methods = study::readSuiteMethods(
      request.methods.value_or(study::standardMethodsFile()), request.settings);
  const study::SuiteSplit split =
      request.split == "train" ? study::SuiteSplit::train : study::SuiteSplit::test;
  const study::DrawnSuite drawn =
      study::drawSuite(suite, methods, split, request.seed, request.scenes);
  if (request.out) study::writeSuite(drawn, report::suiteManifest(drawn), *request.out);
  printLine(fmt::format("{}  {}, {}, seed {}, {} scenes", drawn.sha256, drawn.suite,
                        study::splitName(split), drawn.seed, drawn.studies.size()));
  return ExitStatus::pass;
}

namespace fs = std::filesystem;
namespace {

constexpr const char* gatherExamples = R"(
DIR holds the folders of scenes that were drawn for a suite, as `gnomon run` leaves them in its --out.

Examples:
  gnomon gather out
  gnomon gather night-1 night-2 --out both
  gnomon gather train --choose chosen.toml     # for gnomon suite --split test --settings
  gnomon gather second-seed --out second --against first/suite.json)";

const report::FolderKind suiteKind{
    "suite.json", {"suite.csv", "suite.md", "suite.html"}, "suite.txt", true};

std::vector<report::FinishedScene> readAll(const std::vector<fs::path>& folders) {
  std::vector<report::FinishedScene> scenes;
  std::map<std::string, fs::path> names;
  for (const fs::path& folder : folders) {
    for (report::FinishedScene& scene : report::readFinishedScenes(folder)) {
      const auto [first, isNew] = names.try_emplace(scene.means.name, scene.folder);
      if (!isNew) {
        throw InputError(
            fmt::format("{}: \"{}\" found, which {} holds too; each scene once expected",
                        scene.folder.string(), scene.means.name, first->second.string()));
      }
      scenes.push_back(std::move(scene));
    }
  }
  return scenes;
}

/// @throws InputError
std::string requireSuite(const std::vector<study::StudyMeans>& scenes, const fs::path& folder) {
  std::set<std::string> suites;
  for (const study::StudyMeans& scene : scenes) suites.insert(scene.suite);
  if (suites.size() > 1) {
    throw InputError(fmt::format("{}: scenes of \"{}\" and \"{}\" found, of one suite expected",
                                 folder.string(), *suites.begin(), *suites.rbegin()));
  }
  if (scenes.size() < compare::leastScenes) {
    throw InputError(fmt::format("{}: {} finished scenes of a suite found, {} or more expected",
                                 folder.string(), scenes.size(), compare::leastScenes));
  }
  return *suites.begin();
}

/// Where a scene's page is, seen from the folder of the suite's page; empty where its run wrote
/// none.
std::string relativeReport(const fs::path& scene, const fs::path& out) {
  std::error_code failure;
  if (!fs::exists(scene / "report.html", failure)) return "";
  const fs::path page = fs::absolute(scene / "report.html").lexically_normal();
  return page.lexically_relative(fs::absolute(out).lexically_normal()).generic_string();
}

void printAgreement(const study::SuiteAgreement& agreement, const fs::path& other) {
  if (!agreement.tau) {
    throw InputError(
        fmt::format("{}: {} methods with a rank in both found, two or more of different means "
                    "expected",
                    other.string(), agreement.methods));
  }
  printLine(
      fmt::format("Against {}: Kendall's τ-b {:.3f} over {} methods; {} of {} pairs in another "
                  "order, {} of them distinguishable",
                  other.string(), *agreement.tau, agreement.methods, agreement.swapped,
                  agreement.pairs, agreement.contradictions.size()));
  for (const auto& [first, second] : agreement.contradictions) {
    printLine(fmt::format("  {} before {} here, behind it there", first, second));
  }
}

/// Settings that were chosen on the scenes of train.
struct Choice {
  study::SuiteMethods methods;
  std::vector<study::TriedSetting> tried;
};

/// @throws InputError
Choice chooseSettings(const GatherRequest& request, const compare::SceneTable& train) {
  Choice choice;
  choice.methods =
      study::readSuiteMethods(request.methods.value_or(study::standardMethodsFile()), {});
  choice.tried = study::triedSettings(choice.methods, train);
  return choice;
}

void writeChoice(const Choice& choice, const study::SuiteStatistics& statistics,
                 const fs::path& file) {
  const std::string scenes =
      fmt::format("{}, {} scenes", statistics.suite, statistics.table.scenes.size());
  printText(report::terminalTable(report::suiteSettingsTable(choice.methods, choice.tried)));
  writeTextAtomically(file, report::chosenSettingsText(choice.methods, choice.tried, scenes));
  printLine("Chosen settings: " + file.string());
}

/// What the command reads.
std::vector<fs::path> inputsOf(const GatherRequest& request,
                               const std::vector<report::FinishedScene>& scenes) {
  std::vector<fs::path> files = {request.methods.value_or(study::standardMethodsFile())};
  if (request.against) files.push_back(*request.against);
  for (const report::FinishedScene& scene : scenes) files.push_back(scene.folder / "summary.json");
  return files;
}

}  // namespace

CLI::App* addGatherCommand(CLI::App& app, GatherRequest& request) {
  CLI::App* command = app.add_subcommand(
      "gather", "Statistics over the drawn scenes that finished runs have measured");
  command->add_option("DIR", request.folders, "Folders of results")->required()->type_name("DIR…");
  command->add_option("--out", request.out, "Folder for the statistics")
      ->capture_default_str()
      ->type_name("DIR");
  command
      ->add_option("--against", request.against,
                   "Also compare the ranking with that of another suite.json")
      ->type_name("FILE");
  command
      ->add_option("--choose", request.choose,
                   "Of scenes of train: write the settings with the least mean error to this file")
      ->type_name("FILE");
  command
      ->add_option("--methods", request.methods,
                   "The list of methods that they were drawn with; scenes/suite/methods.toml by "
                   "default")
      ->needs("--choose")
      ->type_name("FILE");
  addPaperOptions(*command, request.paper);
  command->footer(gatherExamples);
  return command;
}

ExitStatus gatherScenes(const GatherRequest& request) {
  const std::vector<report::FinishedScene> scenes = readAll(request.folders);
  std::vector<study::StudyMeans> studies;
  studies.reserve(scenes.size());
  for (const report::FinishedScene& scene : scenes) studies.push_back(scene.means);
  const std::string suite = requireSuite(studies, request.folders.front());
  std::optional<study::SuiteRanking> other;
  if (request.against) other = report::readSuiteRanking(*request.against);

  study::SuiteStatistics statistics = study::suiteStatistics(suite, studies);
  for (study::SuiteScene& scene : statistics.scenes) {
    for (const report::FinishedScene& finished : scenes) {
      if (finished.means.name == scene.name) {
        scene.report = relativeReport(finished.folder, request.out);
      }
    }
  }
  std::vector<std::string> labels;
  for (const study::SuiteMethod& method : statistics.methods) labels.push_back(method.label);
  requirePaperMethods(request.paper, labels);
  std::optional<Choice> choice;
  if (request.choose) choice = chooseSettings(request, statistics.table);
  const std::vector<fs::path> inputs = inputsOf(request, scenes);
  if (request.choose) requireNoInput("--choose", *request.choose, inputs);
  report::RunFolder folder(request.out, suiteKind);
  folder.requireNone(inputs);
  folder.clear();
  report::writeSuiteFiles(statistics, studies, request.command, request.paper, folder);
  folder.finish(report::suiteJson(statistics, request.command));
  printLine(fmt::format("{}: {} scenes, {} methods", suite, statistics.table.scenes.size(),
                        statistics.methods.size()));
  if (other) {
    printAgreement(study::agreementOf(study::rankingOf(statistics), *other), *request.against);
  }
  if (choice) writeChoice(*choice, statistics, *request.choose);
  printLine("Report: " + (request.out / "suite.html").string());
  return ExitStatus::pass;
}

}  // namespace gnomon::cli
