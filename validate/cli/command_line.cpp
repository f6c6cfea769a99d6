#include "cli/command_line.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <optional>

#include "cli/compare_command.h"
#include "cli/export_command.h"
#include "cli/run_command.h"
#include "common/error.h"
#include "render/method.h"
#include "study/result_metrics.h"

namespace gnomon {
namespace {

constexpr const char* runExamples = R"(
Examples:
  gnomon run scenes/figure8.toml
  gnomon run scenes/sphere-columns.toml scenes/sphere-columns-flat.toml --out results
  gnomon run scenes/figure8.toml --set relief.height=4 --set bake.azimuths=16
  gnomon run scenes/figure8.toml --method onoue-2004 --quick)";

constexpr const char* checkExamples = R"(
Exit status: 0 all thresholds hold, 1 one failed, 2 usage, 3 bad input, 4 internal or out of memory,
77 no usable OpenGL.

Examples:
  gnomon check scenes/figure8.toml
  gnomon check scenes/*.toml --quick)";

constexpr const char* exportExamples = R"(
Writes OUT/NAME/export: export.json explains displaced.ply, base.obj, heights.exr, tables.exr and the
sample maps, truths and regions of interest of every view.

Examples:
  gnomon export scenes/figure8.toml
  gnomon export scenes/figure8.toml --subdivisions 9
  gnomon compare mine.png out/figure8/export/masks/camera_elevation-24-azimuth-165_truth.png)";

std::string joinedCommand(int argc, char** argv) {
  std::string text = "gnomon";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool plain = word.find_first_of(" '\"\\$`&|;<>()*?[]#~") == std::string::npos;
    text += plain && !word.empty() ? " " + word : " '" + word + "'";
  }
  return text;
}

void addStudyOptions(CLI::App& command, RunRequest& request) {
  command.add_option("STUDY", request.studies, "Study files")->required()->type_name("FILE…");
  command.add_option("--out", request.out, "Folder for the results, one folder a study in it")
      ->capture_default_str()
      ->type_name("DIR");
  command
      .add_option("--set", request.options.overrides,
                  "Override a key of the study, as relief.height=4 or light.0.elevation=30")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void addQuickOption(CLI::App& command, RunRequest& request) {
  command.add_flag("--quick", request.options.quick,
                   "A quarter of each view's side, a sixteenth of the micro-mesh: a preview");
}

void addRunOptions(CLI::App& command, RunRequest& request) {
  addStudyOptions(command, request);
  command
      .add_option("--method", request.options.methods,
                  "Only this method, by label or name; may be repeated")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addQuickOption(command, request);
}

ExitStatus listParts() {
  fmt::print("Methods ([[method]] name):\n");
  const auto shaders = shaderFolder();
  for (const std::string& name : methodNames(shaders)) {
    const Method method = readMethod(methodFile(shaders, name));
    fmt::print("  {:<22} {} ({})\n", name, method.title, method.citation);
    for (const auto& [key, parameter] : method.parameters) {
      fmt::print("    {} = {} ({} to {}): {}\n", key, parameter.standard, parameter.minimum,
                 parameter.maximum, parameter.about);
    }
  }
  fmt::print("\nShapes ([surface] shape): plane, cylinder, sphere, torus, bezier, b-spline\n");
  fmt::print("Patterns ([relief] pattern): columns, cosine, cells, ripples\n");
  fmt::print("Metrics ([[threshold]] metric): {}\n", fmt::join(metricNames(), ", "));
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

int dispatch(int argc, char** argv) {
  CLI::App app("Gnomon measures how right real-time bump-map shadows are.", "gnomon");
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", GNOMON_VERSION);
  std::optional<int> threads;
  app.add_option("--threads", threads, "Threads to use; all cores, if not given")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  app.fallthrough();
  app.footer("\nSee `gnomon COMMAND --help` for options and examples.");

  RunRequest request;
  request.command = joinedCommand(argc, argv);
  CLI::App* run = app.add_subcommand("run", "Measure studies and write their reports");
  addRunOptions(*run, request);
  run->footer(runExamples);
  CLI::App* check =
      app.add_subcommand("check", "As run, then the studies' thresholds decide the exit status");
  addRunOptions(*check, request);
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
        "a command expected: run, check, compare, bake, truth, export or list. See gnomon --help");
  }
  const ThreadLimit limit(threads);
  // Our own error says what each platform answered; Mesa's warnings would stand beside it.
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  request.check = check->parsed();
  const ExitStatus status = list->parsed()       ? listParts()
                            : compare->parsed()  ? compareMasks(comparison)
                            : bake->parsed()     ? bakeStudies(request)
                            : truth->parsed()    ? traceStudies(request)
                            : exported->parsed() ? exportStudies(request, subdivisions)
                                                 : runStudies(request);
  return static_cast<int>(status);
}

/// Messages quote files, drivers and keys: whatever they hold, an error is one line.
void printError(std::string message) {
  const auto isControl = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  message.erase(std::find_if_not(message.rbegin(), message.rend(), isControl).base(),
                message.end());
  std::replace_if(message.begin(), message.end(), isControl, ' ');
  fmt::print(stderr, "gnomon: {}\n", message);
}

}  // namespace

int runCommandLine(int argc, char** argv) {
  try {
    return dispatch(argc, argv);
  } catch (const Error& error) {
    printError(error.what());
    return static_cast<int>(error.status());
  } catch (const std::bad_alloc&) {
    printError("out of memory");
  } catch (const std::exception& error) {
    printError(fmt::format("internal error: {}", error.what()));
  }
  return static_cast<int>(ExitStatus::internal);
}

}  // namespace gnomon
