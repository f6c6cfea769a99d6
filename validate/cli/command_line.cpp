#include "cli/command_line.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

#include "cli/cache_command.h"
#include "cli/check_command.h"
#include "cli/compare_command.h"
#include "cli/export_command.h"
#include "cli/failure.h"
#include "cli/junit_file.h"
#include "cli/list_option.h"
#include "cli/output.h"
#include "cli/run_command.h"
#include "cli/view_command.h"
#include "common/error.h"
#include "common/system/interruption.h"
#include "common/text/shell_quote.h"
#include "render/method.h"
#include "study/record/result_metrics.h"
#include "study/run/method_trial.h"

namespace gnomon {
namespace {

constexpr const char* runExamples = R"(
Examples:
  gnomon run scenes/figure8.toml
  gnomon run scenes/sphere-columns.toml scenes/sphere-columns-flat.toml --out results
  gnomon run scenes/figure8.toml --set relief.height=4 --set bake.azimuths=16
  gnomon run scenes/figure8.toml --method onoue-2004 --quick)";

constexpr const char* checkExamples = R"(
Exit status: 0 all thresholds and references hold, 1 one failed or is undefined, 2 usage, 3 bad
input, 4 internal or out of memory, 77 no usable OpenGL. All studies are checked, whatever becomes of
one; of several statuses it is the largest.

Examples:
  gnomon check scenes/figure8.toml
  gnomon check scenes/*.toml --quick --gated --junit check.xml --github
  gnomon check scenes/*.toml --baseline results/reference
  gnomon check scenes/figure8.toml --replace onoue-2004=mine.glsl
  gnomon check scenes/*.toml --baseline results/reference --update-baseline --reason "why")";

constexpr const char* exportExamples = R"(
Writes OUT/NAME/export: export.json explains displaced.ply, base.obj, heights.exr, tables.exr and the
sample maps, truths and regions of interest of every view.

Examples:
  gnomon export scenes/figure8.toml
  gnomon export scenes/figure8.toml --subdivisions 9
  gnomon compare mine.png out/figure8/export/masks/camera_elevation-24-azimuth-165_truth.png)";

constexpr const char* cacheExamples = R"(
The folder is the environment's GNOMON_CACHE, else gnomon in XDG_CACHE_HOME, else ~/.cache/gnomon.
What was used longest ago makes room.

Examples:
  gnomon cache
  gnomon cache --limit 20GB
  gnomon cache --clear)";

std::string joinedCommand(int argc, char** argv) {
  std::string text = "gnomon";
  for (int i = 1; i < argc; ++i) text += " " + shellQuoted(argv[i]);
  return text;
}

void addStudyOptions(CLI::App& command, RunRequest& request) {
  command.add_option("STUDY", request.studies, "Study files; /dev/stdin is one from a pipe")
      ->required()
      ->type_name("FILE…");
  command.add_option("--out", request.out, "Folder for the results, one folder a study in it")
      ->capture_default_str()
      ->type_name("DIR");
  addList(command, "--set", request.options.overrides,
          "Override a key of the study, as relief.height=4 or light.0.elevation=30", "KEY=VALUE");
  command.add_flag("--no-cache", request.noCache,
                   "Compute everything: take nothing from earlier runs, and leave nothing");
}

void addQuickOption(CLI::App& command, RunRequest& request) {
  command.add_flag("--quick", request.options.quick,
                   "A quarter of each view's side, a sixteenth of the micro-mesh: a preview");
}

void addRunOptions(CLI::App& command, RunRequest& request) {
  addStudyOptions(command, request);
  addList(command, "--method", request.options.methods,
          "Only this method, by label or name; may be repeated", "NAME");
  addList(command, "--replace", request.options.replacements,
          "Another shader in a method's place, which keeps its label and with it its thresholds: a "
          "method's name or a GLSL file",
          "METHOD=SHADER");
  command.add_flag("--vary-radius", request.varyRadius,
                   "Judge claims and verdicts at half and at twice the search radius too, and mark "
                   "those that turn");
  addQuickOption(command, request);
}

void addCheckOptions(CLI::App& command, CheckRequest& request) {
  addRunOptions(command, request.run);
  command.add_flag("--gated", request.run.options.gatedOnly,
                   "Only the methods that thresholds speak of");
  command.add_option("--junit", request.junit, "Write the check as JUnit XML")->type_name("FILE");
  command.add_flag("--github", request.github,
                   "Print annotations for a pull request on GitHub, on standard output");
  command
      .add_option("--baseline", request.baseline,
                  "Judge by the references DIR/NAME.json too: nothing may have become worse")
      ->type_name("DIR");
  command.add_flag("--update-baseline", request.updateBaseline,
                   "Write the references anew, of studies whose thresholds hold");
  command.add_option("--reason", request.reason, "Why they change; kept in the references")
      ->type_name("TEXT");
  command.add_flag("--baseline-pictures", request.baselinePictures,
                   "With --update-baseline: keep each method's signed difference beside the "
                   "references, some 20 kB each, so that a report of a reference that fails shows "
                   "old, new and what changed");
}

ExitStatus listParts() {
  printLine("Methods ([[method]] name):");
  const auto shaders = shaderFolder();
  for (const std::string& name : methodNames(shaders)) {
    const Method method = readMethod(methodFile(shaders, name));
    printLine(fmt::format("  {:<22} {} ({})", name, method.title, method.citation));
    for (const auto& [key, parameter] : method.parameters) {
      printLine(fmt::format("    {} = {} ({} to {}): {}", key, parameter.standard,
                            parameter.minimum, parameter.maximum, parameter.about));
    }
  }
  printText("\nShapes ([surface] shape): plane, cylinder, sphere, torus, bezier, b-spline\n");
  printLine("Patterns ([relief] pattern): columns, cosine, cells, ripples");
  printLine(fmt::format("Metrics ([[threshold]] metric): {}", fmt::join(metricNames(), ", ")));
  return ExitStatus::pass;
}

/// Holds the threads of everything that the process runs to a number, until it goes.
class ThreadLimit {
 public:
  explicit ThreadLimit(std::optional<int> threads) {
    if (!threads) return;
    limit_.emplace(tbb::global_control::max_allowed_parallelism,
                   static_cast<std::size_t>(*threads));
    // Mesa's software renderer reads its own.
    setenv("LP_NUM_THREADS", fmt::format("{}", *threads).c_str(), 0);
  }

 private:
  std::optional<tbb::global_control> limit_;
};

int dispatch(int argc, char** argv, const Viewer& viewer) {
  CLI::App app("Gnomon measures how right real-time bump-map shadows are.", "gnomon");
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", GNOMON_VERSION);
  std::optional<int> threads;
  app.add_option("--threads", threads, "Threads to use; all cores, if not given")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  app.fallthrough();
  app.footer("\nSee `gnomon COMMAND --help` for options and examples.");

  CheckRequest checkRequest;
  RunRequest& request = checkRequest.run;
  request.command = joinedCommand(argc, argv);
  CLI::App* run = app.add_subcommand("run", "Measure studies and write their reports");
  addRunOptions(*run, request);
  run->footer(runExamples);
  CLI::App* check = app.add_subcommand(
      "check", "As run, then the studies' thresholds and references decide the exit status");
  addCheckOptions(*check, checkRequest);
  check->footer(checkExamples);
  CLI::App* bake = app.add_subcommand("bake", "Bake the horizon and distance tables into an EXR");
  addStudyOptions(*bake, request);
  bake->footer("\nExample:\n  gnomon bake scenes/figure8.toml --set bake.azimuths=64");
  CLI::App* truth =
      app.add_subcommand("truth", "Trace the truth alone: masks, regions and their uncertainty");
  addStudyOptions(*truth, request);
  addQuickOption(*truth, request);
  truth->footer("\nExample:\n  gnomon truth scenes/figure8.toml --out truths");
  std::optional<int> subdivisions;
  CLI::App* exported = app.add_subcommand(
      "export", "Write what another renderer needs: meshes, maps, samples, truths, camera, lights");
  addStudyOptions(*exported, request);
  addQuickOption(*exported, request);
  exported
      ->add_option("--subdivisions", subdivisions,
                   "Pieces of every face's side in the displaced mesh; 4 a texel, if not given, or "
                   "what keeps to 4 million triangles")
      ->type_name("N");
  exported->footer(exportExamples);
  CompareRequest comparison;
  comparison.command = request.command;
  CLI::App* compare = addCompareCommand(app, comparison);
  ViewRequest viewRequest;
  viewRequest.tryMethod = [](const MethodSpec& method, Wrap wrap) {
    (void)tryMethod(method, wrap);
  };
  CLI::App* view = addViewCommand(app, viewRequest);
  CacheRequest cacheRequest;
  CLI::App* cache = app.add_subcommand("cache", "Show what runs left to be taken up, and bound it");
  cache->add_flag("--clear", cacheRequest.clear, "Remove all of it");
  cache->add_option("--limit", cacheRequest.limit, "Keep at most so much, from now on: 500MB, 4GB")
      ->type_name("BYTES");
  cache->footer(cacheExamples);
  CLI::App* list = app.add_subcommand("list", "List methods, shapes, patterns and metrics");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    if (asked) return app.exit(error);
    throw UsageError(fmt::format("{}. See gnomon --help", error.what()));
  }
  if (app.get_subcommands().empty()) {
    throw UsageError(
        "a command expected: run, check, compare, bake, truth, export, view, cache or list. "
        "See gnomon --help");
  }
  const ThreadLimit limit(threads);
  // Our own error says what each platform answered; Mesa's warnings would stand beside it.
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  const ExitStatus status = list->parsed()       ? listParts()
                            : cache->parsed()    ? showCache(cacheRequest)
                            : compare->parsed()  ? compareMasks(comparison)
                            : view->parsed()     ? viewer(viewRequest)
                            : bake->parsed()     ? bakeStudies(request)
                            : truth->parsed()    ? traceStudies(request)
                            : exported->parsed() ? exportStudies(request, subdivisions)
                            : check->parsed()    ? checkStudies(checkRequest)
                                                 : runStudies(request);
  return static_cast<int>(status);
}

}  // namespace

int runCommandLine(int argc, char** argv, const Viewer& viewer) {
  cleanUpOnSignals();
  prepareStreams();
  const JunitFile junit({argv, static_cast<std::size_t>(argc)}, joinedCommand(argc, argv));
  try {
    if (argc > 1 && std::string_view(argv[1]) == trialArgument) {
      return static_cast<int>(answerTrial(std::vector<std::string>(argv + 2, argv + argc)));
    }
    junit.open();
    const int status = dispatch(argc, argv, viewer);
    flushOutput();
    const bool isWhole = status != 0 || !isErrorLost();
    return isWhole ? status : static_cast<int>(ExitStatus::badInput);
  } catch (...) {
    const Failure failure = currentFailure();
    junit.fail(failure);
    printFailure(failure);
    return static_cast<int>(failure.status);
  }
}

}  // namespace gnomon
