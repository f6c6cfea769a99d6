#include "cli/commands/suite_command.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "cli/output.h"
#include "report/json/suite_json.h"
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

}  // namespace gnomon::cli
