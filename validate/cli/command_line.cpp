#include "cli/command_line.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "cli/commands/baseline_check.h"
#include "cli/commands/cache_command.h"
#include "cli/commands/check_command.h"
#include "cli/commands/compare_command.h"
#include "cli/commands/init_command.h"
#include "cli/commands/rank_command.h"
#include "cli/commands/run_command.h"
#include "cli/commands/shards.h"
#include "cli/commands/suite_command.h"
#include "cli/output.h"
#include "common/error.h"
#include "common/system/process.h"
#include "common/text.h"
#include "render/method.h"
#include "study/record/cases.h"
#include "study/run/method_trial.h"
#include "study/spec/study_file.h"
#include "study/spec/study_sections.h"

namespace gnomon::cli {

namespace {

constexpr const char* runExamples = R"(
Examples:
  gnomon run scenes/figure8.toml
  gnomon run scenes/sphere-columns.toml scenes/sphere-columns-flat.toml --out results
  gnomon run scenes/figure8.toml --set relief.height=4 --set bake.azimuths=16
  gnomon run scenes/figure8.toml --method onoue-2004 --quick
  gnomon run scenes/figure8.toml --figures column --paper-method onoue-2004 --paper-method max-forsyth)";

constexpr const char* checkExamples = R"(
Exit status: 0 all thresholds and references hold, 1 one failed or is undefined, 2 usage, 3 bad
input, 4 internal error or out of memory, 77 no usable OpenGL. All studies are checked, even if one
fails; the largest status is returned.

Examples:
  gnomon check scenes/figure8.toml
  gnomon check scenes/*.toml --quick --gated --junit check.xml --github
  gnomon check scenes/*.toml --baseline results/reference
  gnomon check scenes/figure8.toml --replace onoue-2004=mine.glsl
  gnomon check scenes/*.toml --baseline results/reference --update-baseline --reason "why")";

constexpr const char* exportExamples = R"(
Writes OUT/NAME/export: export.json describes displaced.ply, base.obj, heights.exr, tables.exr and the
sample maps, truths and regions of interest of every view.

Examples:
  gnomon export scenes/figure8.toml
  gnomon export scenes/figure8.toml --subdivisions 9
  gnomon compare mine.png out/figure8/export/masks/camera_elevation-24-azimuth-165_truth.png)";

constexpr const char* cacheExamples = R"(
The folder is $GNOMON_CACHE if that is set, else $XDG_CACHE_HOME/gnomon, else ~/.cache/gnomon. The
entries that were used longest ago are removed first.

Examples:
  gnomon cache
  gnomon cache --limit 20GB
  gnomon cache --clear)";

constexpr const char* mergeExamples = R"(
Copies the folders of the shards' cases and writes sweeps, rankings and a suite's statistics from their
summaries. It reads the studies again, by the file names that the shards were given: call it in the same
folder.

Example, each shard on any machine:
  gnomon run scenes/height-sweep.toml --shard 1/2 --out shards/1
  gnomon run scenes/height-sweep.toml --shard 2/2 --out shards/2
  gnomon merge shards/1 shards/2 --out out)";

Arguments argumentsOf(int argc, char** argv) {
  return {argv + std::min(argc, 1), argv + argc};
}

void addStudyOptions(CLI::App& command, RunRequest& request) {
  command.add_option("STUDY", request.studies, "Study files; /dev/stdin reads a study from a pipe")
      ->required()
      ->type_name("FILE…");
  command.add_option("--out", request.out, "Folder for the results, with one folder per study")
      ->capture_default_str()
      ->type_name("DIR");
  addList(command, "--set", request.options.overrides,
          "Override a key of the study, as relief.height=4 or light.0.elevation=30; `gnomon list "
          "keys` names them all",
          "KEY=VALUE");
  command.add_flag("--no-cache", request.noCache,
                   "Do not use the result cache: read nothing from it and write nothing to it");
}

void addQuickOption(CLI::App& command, RunRequest& request) {
  command.add_flag("--quick", request.options.quick,
                   "Preview: a quarter of the width and height of each view, a sixteenth of the "
                   "micro-triangles, no frame timed");
}

void addRunOptions(CLI::App& command, RunRequest& request) {
  addStudyOptions(command, request);
  addList(command, "--method", request.options.methods,
          "Measure only this method, by label or name; may be repeated", "NAME");
  addList(command, "--replace", request.options.replacements,
          "Measure another shader, a method's name or a GLSL file, under the label and the "
          "thresholds of METHOD",
          "METHOD=SHADER");
  CLI::Option* figures = addPaperOptions(command, request.paper);
  command
      .add_flag("--metrics-only", request.metricsOnly,
                "Write figures only: no masks, pictures, pages, plots or times; the same input "
                "then gives the same folder, byte for byte")
      ->excludes(figures);
  addQuickOption(command, request);
}

void addCheckOptions(CLI::App& command, CheckRequest& request) {
  addRunOptions(command, request.run);
  command.add_flag("--gated", request.run.options.gatedOnly,
                   "Measure only the methods that thresholds name");
  command.add_option("--junit", request.junit, "Write the result as JUnit XML")->type_name("FILE");
  command.add_flag("--github", request.github,
                   "Print annotations for a GitHub pull request on standard output");
  command
      .add_option("--summary", request.summary,
                  "Add a job summary in Markdown to a file: outcome, faults, and the worst case's "
                  "pictures before, after and between")
      ->type_name("FILE");
  command
      .add_option("--baseline", request.baseline,
                  "Also compare with the references DIR/NAME.json: no value may be worse")
      ->type_name("DIR");
  command.add_flag("--update-baseline", request.updateBaseline,
                   "Write new references for studies whose thresholds hold");
  command.add_option("--reason", request.reason, "Reason for the change; stored in the references")
      ->type_name("TEXT");
  command.add_flag("--baseline-pictures", request.baselinePictures,
                   "With --update-baseline: store each method's signed difference beside the "
                   "references, about 20 kB each; the report of a failed reference then shows the "
                   "old picture, the new picture and the change");
}

ExitStatus list(const CLI::App& app, const std::string& what) {
  if (!what.empty()) {
    printText(what == "keys" ? study::studyKeysText() : manualPage(app, GNOMON_VERSION));
    return ExitStatus::pass;
  }
  printLine("Methods ([[method]] name):");
  const auto shaders = render::shaderFolder();
  for (const std::string& name : render::methodNames(shaders)) {
    const render::Method method = render::readMethod(render::methodFile(shaders, name));
    printLine(fmt::format("  {:<22} {} ({})", name, method.title, method.citation));
    for (const auto& [key, parameter] : method.parameters) {
      printLine(fmt::format("    {} = {} ({}): {}", key, parameter.textOf(parameter.defaultValue),
                            parameter.rangeText(), parameter.about));
    }
  }
  printLine(fmt::format("\nShapes ([surface] shape): {}", fmt::join(study::shapeNames, ", ")));
  printLine(fmt::format("Patterns ([relief] pattern): {}", fmt::join(study::patternNames, ", ")));
  printLine(fmt::format("Solids ([relief] solid): {}", fmt::join(study::solidNames, ", ")));
  printLine(fmt::format("Metrics ([[threshold]] metric): {}",
                        fmt::join(compare::namesOf(compare::allMetrics()), ", ")));
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

/// Numbers of threads, which every command takes.
void addThreadsOption(CLI::App& app, std::optional<int>& threads) {
  app.add_option("--threads", threads, "Number of threads; all cores by default")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  app.fallthrough();
}

/// The words of a `gnomon run`, as a shard has kept them.
RunRequest readRun(const Arguments& arguments) {
  CLI::App app("", "gnomon");
  std::optional<int> threads;
  addThreadsOption(app, threads);
  RunRequest request;
  addRunOptions(*app.add_subcommand("run"), request);
  try {
    app.parse(Arguments(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    throw InputError(
        fmt::format("`{}`, the shards' command: {}", commandText(arguments), error.what()));
  }
  return request;
}

CLI::App* addMergeCommand(CLI::App& app, MergeRequest& request) {
  request.readRun = readRun;
  CLI::App* merge = app.add_subcommand("merge", "Put the shards of a run together");
  merge->add_option("DIR", request.shards, "Folders of results of all shards, in any order")
      ->required()
      ->type_name("DIR…");
  merge->add_option("--out", request.out, "Folder for the results, with one folder per study")
      ->capture_default_str()
      ->type_name("DIR");
  merge->add_flag("--no-cache", request.noCache,
                  "Do not use the result cache, which keeps plots: read nothing from it and write "
                  "nothing to it");
  merge->footer(mergeExamples);
  return merge;
}

/// What the words that no option or command has taken were probably meant to be: "; did you mean
/// --difference?"
std::string suggestion(const CLI::App& app) {
  std::set<std::string, std::less<>> commands, options;
  for (const CLI::App* command : app.get_subcommands(nullptr)) commands.insert(command->get_name());
  const auto addOptions = [&](const CLI::App& of) {
    for (const CLI::Option* option : of.get_options()) {
      options.insert(option->get_lnames().begin(), option->get_lnames().end());
    }
  };
  addOptions(app);
  for (const CLI::App* command : app.get_subcommands()) addOptions(*command);
  for (const std::string& word : app.remaining(true)) {
    const bool isOption = word.starts_with("--");
    if (!isOption && !app.get_subcommands().empty()) continue;
    const std::string typed = isOption ? word.substr(2, word.find('=') - 2) : word;
    const auto meant = nearestName(typed, isOption ? options : commands);
    if (meant) return fmt::format("; did you mean {}{}?", isOption ? "--" : "", *meant);
    if (!isOption) return fmt::format("; one of {} expected.", fmt::join(commands, ", "));
  }
  return ".";
}

[[gnu::noinline]] int dispatch(int argc, char** argv, const Viewer& viewer) {
  CLI::App app("Gnomon measures how accurate real-time bump-map shadows are.", "gnomon");
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", GNOMON_VERSION);
  std::optional<int> threads;
  addThreadsOption(app, threads);
  app.footer("\nSee `gnomon COMMAND --help` for options and examples.");

  CheckRequest checkRequest;
  RunRequest& request = checkRequest.run;
  request.arguments = argumentsOf(argc, argv);
  request.command = commandText(request.arguments);
  CLI::App* run = app.add_subcommand("run", "Measure studies and write their reports");
  addRunOptions(*run, request);
  std::optional<std::string> shard;
  run->add_option("--shard", shard,
                  "Run only the I-th of N equal parts of all cases; merge puts them together. "
                  "Without it an array of Slurm or a sharded test says which")
      ->type_name("I/N");
  run->footer(runExamples);
  CLI::App* check = app.add_subcommand(
      "check", "Measure studies like run, then judge their thresholds and references");
  addCheckOptions(*check, checkRequest);
  check->footer(checkExamples);
  CLI::App* bake = app.add_subcommand("bake", "Write the horizon and distance tables as an EXR");
  addStudyOptions(*bake, request);
  bake->footer("\nExample:\n  gnomon bake scenes/figure8.toml --set bake.azimuths=64");
  CLI::App* truth = app.add_subcommand(
      "truth", "Trace the truth without any method: masks, regions and their uncertainty");
  addStudyOptions(*truth, request);
  addQuickOption(*truth, request);
  truth->footer("\nExample:\n  gnomon truth scenes/figure8.toml --out truths");
  std::optional<int> subdivisions;
  CLI::App* exported = app.add_subcommand(
      "export", "Write meshes, maps, samples, truths, cameras and lights for another renderer");
  addStudyOptions(*exported, request);
  addQuickOption(*exported, request);
  exported
      ->add_option("--subdivisions", subdivisions,
                   "Pieces per side of each face in the displaced mesh; by default 8 per texel, at "
                   "most 4 million triangles in all")
      ->type_name("N");
  exported->footer(exportExamples);
  MergeRequest merging;
  CLI::App* merge = addMergeCommand(app, merging);
  CompareRequest comparison;
  comparison.command = request.command;
  CLI::App* compare = addCompareCommand(app, comparison);
  ViewRequest viewRequest;
  viewRequest.tryMethod = [](const study::MethodSpec& method, relief::Wrap wrap) {
    (void)study::tryMethod(method, wrap);
  };
  CLI::App* view = addViewCommand(app, viewRequest);
  CacheRequest cacheRequest;
  CLI::App* cache = app.add_subcommand("cache", "Show, clear or limit the result cache");
  cache->add_flag("--clear", cacheRequest.clear, "Remove all entries");
  cache
      ->add_option("--limit", cacheRequest.limit,
                   "Largest size of the cache from now on, for example 500MB or 4GB")
      ->type_name("BYTES");
  cache->footer(cacheExamples);
  GatherRequest gatherRequest;
  gatherRequest.command = request.command;
  CLI::App* gather = addGatherCommand(app, gatherRequest);
  RankRequest rankRequest;
  rankRequest.command = request.command;
  CLI::App* rank = addRankCommand(app, rankRequest);
  SuiteRequest suiteRequest;
  CLI::App* suite = addSuiteCommand(app, suiteRequest);
  CLI::App* listed = app.add_subcommand("list", "List methods, shapes, patterns and metrics");
  std::string what;
  listed
      ->add_option("WHAT", what,
                   "In their place `keys`: every key of a study, as Markdown; `manual-page`: "
                   "gnomon(1)")
      ->check(CLI::IsMember({"keys", "manual-page"}))
      ->type_name("WHAT");
  InitRequest initRequest;
  CLI::App* init = addInitCommand(app, initRequest);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    if (asked) return app.exit(error);
    throw UsageError(fmt::format("{}{} See gnomon --help", error.what(), suggestion(app)));
  }
  if (app.get_subcommands().empty()) {
    throw UsageError(
        "a command expected: run, rank, merge, gather, check, compare, bake, truth, export, view, "
        "cache, suite, list or init. "
        "See gnomon --help");
  }
  const ThreadLimit limit(threads);
  if (run->parsed()) request.shard = shard ? parseShard(*shard) : shardOfEnvironment();
  // Our own error says what each platform answered; Mesa's warnings would stand beside it.
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  const ExitStatus status = listed->parsed()     ? list(app, what)
                            : init->parsed()     ? writeStarter(initRequest)
                            : gather->parsed()   ? gatherScenes(gatherRequest)
                            : suite->parsed()    ? drawSuiteScenes(suiteRequest)
                            : rank->parsed()     ? rankEntries(rankRequest)
                            : cache->parsed()    ? showCache(cacheRequest)
                            : compare->parsed()  ? compareMasks(comparison)
                            : view->parsed()     ? viewer(viewRequest)
                            : bake->parsed()     ? bakeStudies(request)
                            : truth->parsed()    ? traceStudies(request)
                            : exported->parsed() ? exportStudies(request, subdivisions)
                            : check->parsed()    ? checkStudies(checkRequest)
                            : merge->parsed()    ? mergeShards(merging)
                                                 : runStudies(request);
  return static_cast<int>(status);
}

/// A stack that no command overflows, nor a thread, which gets as large a one.
/// @throws InputError for less, while there is enough to say so
void requireStack() {
  constexpr rlim_t least = 256;  // kB; with half of it runs of figures still end well
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur / 1024 >= least) return;
  throw InputError(fmt::format("the stack is limited to {} kB, {} kB or more expected: ulimit -s",
                               limit.rlim_cur / 1024, least));
}

/// A relative folder of the XDG Base Directory Specification is invalid and ignored there, which
/// OpenGL's libraries do not know.
void forgetRelativeFolders() {
  for (const char* name : {"XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME",
                           "XDG_RUNTIME_DIR"}) {
    const char* folder = std::getenv(name);
    if (folder != nullptr && *folder != '/') unsetenv(name);
  }
}

}  // namespace

int runCommandLine(int argc, char** argv, const Viewer& viewer) {
  cleanUpOnSignals();
  prepareStreams();
  try {
    requireStack();
  } catch (const InputError& error) {
    printFailure({error.status(), error.what()});
    return static_cast<int>(error.status());
  }
  forgetRelativeFolders();
  const JunitFile junit({argv, static_cast<std::size_t>(argc)},
                        commandText(argumentsOf(argc, argv)));
  try {
    if (argc > 1 && std::string_view(argv[1]) == study::trialArgument) {
      return static_cast<int>(study::answerTrial(std::vector<std::string>(argv + 2, argv + argc)));
    }
    junit.open();
    const int status = dispatch(argc, argv, viewer);
    flushOutput();
    const bool isWhole = status != 0 || !isErrorLost();
    return isWhole ? status : static_cast<int>(ExitStatus::badInput);
  } catch (const ClosedPipe& closed) {
    junit.fail(currentFailure());
    return static_cast<int>(closed.status());
  } catch (...) {
    const Failure failure = currentFailure();
    junit.fail(failure);
    printFailure(failure);
    return static_cast<int>(failure.status);
  }
}

namespace {

/// Text in which no line is a request to the formatter and no sign is changed by it.
std::string escaped(const std::string& text) {
  std::string result;
  bool opensLine = true;
  for (const char c : text) {
    if (opensLine && (c == '.' || c == '\'')) result += "\\&";
    if (c == '-' || c == '\\') result += c == '-' ? "\\" : "\\e";
    if (c != '\\') result += c;
    opensLine = c == '\n';
  }
  return result;
}

/// "--out DIR", "STUDY FILE…" or "--quick".
std::string headOf(const CLI::Option& option) {
  const std::string name = option.get_name(option.get_positional(), true);
  const std::string type = option.get_type_name();
  return type.empty() || option.get_items_expected_max() == 0 ? name : name + " " + type;
}

std::string entryOf(const CLI::Option& option) {
  std::string text =
      fmt::format(".TP\n.B {}\n{}", escaped(headOf(option)), escaped(option.get_description()));
  if (!option.get_default_str().empty()) {
    text += fmt::format(" (default: {})", escaped(option.get_default_str()));
  }
  return text + "\n";
}

std::string optionsOf(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) text += entryOf(*option);
  return text;
}

/// As it is, line by line.
std::string verbatim(const std::string& text) {
  const std::size_t begin = text.find_first_not_of('\n');
  if (begin == std::string::npos) return "";
  return fmt::format(".PP\n.nf\n{}\n.fi\n", escaped(text.substr(begin)));
}

}  // namespace

std::string manualPage(const CLI::App& app, const std::string& version) {
  const std::string& name = app.get_name();
  std::string text = fmt::format(
      ".TH GNOMON 1 \"\" \"Gnomon {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B "
      "{}\n"
      ".I COMMAND\n[OPTIONS]\n.SH OPTIONS\n{}.SH COMMANDS\n",
      escaped(version), name, escaped(app.get_description()), name, optionsOf(app));
  for (const CLI::App* command : app.get_subcommands({})) {
    text += fmt::format(".SS {}\n{}\n{}{}", escaped(command->get_name()),
                        escaped(command->get_description()), optionsOf(*command),
                        verbatim(command->get_footer()));
  }
  return text;
}

}  // namespace gnomon::cli
