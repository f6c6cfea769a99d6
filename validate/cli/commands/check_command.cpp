#include "cli/commands/check_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "cli/commands/baseline_check.h"
#include "cli/commands/cache_command.h"
#include "cli/output.h"
#include "cli/plan_runs.h"
#include "cli/study_plans.h"
#include "common/files/atomic_file.h"
#include "common/lists.h"
#include "common/text.h"
#include "compare/metric.h"
#include "report/build_server.h"
#include "report/plots/gnuplot.h"
#include "report/terminal_report.h"
#include "report/view_images.h"
#include "study/judge/gates.h"
#include "study/spec/sections/method_section.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

/// One study file on its way through a check.
struct Study {
  study::CheckRecord check;
  std::optional<study::StudyPlan> plan;  ///< none, if the file cannot be read
  std::optional<PlanRecords> part;       ///< none, until it has been run
  /// What it is judged by, or what an update replaces; none, if the file is missing or no baseline.
  std::optional<study::Baseline> baseline;
};

void requireSense(const CheckRequest& request) {
  const study::StudyOptions& options = request.run.options;
  if (!request.updateBaseline) {
    if (!request.reason.empty()) throw UsageError("--reason: --update-baseline expected with it");
    if (request.baselinePictures) {
      throw UsageError("--baseline-pictures: --update-baseline expected with it");
    }
    return;
  }
  if (!request.baseline) throw UsageError("--update-baseline: --baseline DIR expected with it");
  if (request.baselinePictures && request.run.metricsOnly) {
    throw UsageError("--baseline-pictures: a run with pictures expected, without --metrics-only");
  }
  if (request.reason.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw UsageError("--update-baseline: --reason TEXT expected with it");
  }
  const bool changed = !options.overrides.empty() || !options.methods.empty() ||
                       !options.replacements.empty() || options.gatedOnly;
  if (changed) {
    throw UsageError(
        "--update-baseline: the studies as they are expected, without --set, --method, --replace "
        "and --gated");
  }
}

/// The command that checks one study again; of its methods only those, if there are any.
std::string commandFor(const CheckRequest& request, const std::string& file,
                       const std::vector<std::string>& methods) {
  std::string text = "gnomon check " + shellQuoted(file);
  const study::StudyOptions& options = request.run.options;
  const auto add = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
      text += fmt::format(" {} {}", option, shellQuoted(value));
    }
  };
  if (options.quick) text += " --quick";
  if (request.run.metricsOnly) text += " --metrics-only";
  add("--set", options.overrides);
  add("--replace", options.replacements);
  add("--method", methods.empty() ? options.methods : methods);
  if (options.gatedOnly && methods.empty()) text += " --gated";
  if (request.baseline && !request.updateBaseline) {
    text += " --baseline " + shellQuoted(request.baseline->string());
  }
  return text;
}

/// The methods of the gates that do not hold; none where all are needed to tell.
std::vector<std::string> faultyMethods(const study::CheckRecord& check) {
  std::vector<std::string> methods;
  if (!check.problems.empty()) return methods;
  for (const study::Judgement& judgement : check.judgements) {
    if (judgement.isFault()) appendOnce(methods, judgement.gate.method);
  }
  return methods;
}

void addProblem(study::CheckRecord& check, const char* part) {
  const Failure failure = currentFailure();
  check.problems.push_back({part, failure.status, failure.message});
}

void requireGates(const study::StudyPlan& plan, const CheckRequest& request) {
  const study::StudySpec& study = plan.steps.front();
  if (request.baseline) return;
  const bool judgesMethods =
      std::any_of(study.thresholds.begin(), study.thresholds.end(),
                  [](const study::Gate& gate) { return !compare::isOfTruthAlone(gate.metric); });
  if (judgesMethods) return;
  if (!study.thresholds.empty()) {
    throw InputError(fmt::format(
        "{}: every [[threshold]] is on {}, which is the truth's alone, so no method is checked",
        study.file.string(), study.thresholds.front().metric.name()));
  }
  throw InputError(
      fmt::format("{}: {}, so there is nothing to check", study.file.string(),
                  study.leftOut.empty() ? "no [[threshold]]" : "every [[threshold]] is left out"));
}

/// The user's own shaders of a study, relative to the working folder where they lie below it: so a
/// build server finds them in the repository.
std::map<std::string, std::string> ownShaders(const study::StudyPlan& plan) {
  std::map<std::string, std::string> shaders;
  for (const study::MethodSpec& method : plan.steps.front().methods) {
    if (study::isBuiltIn(method)) continue;
    const fs::path relative = method.file.lexically_proximate(fs::current_path());
    const bool isBelow = method.file.is_absolute() && *relative.begin() != "..";
    shaders[method.label] = (isBelow ? relative : method.file).lexically_normal().string();
  }
  return shaders;
}

/// @throws UsageError for a summary that would be added to a file that the check reads, or to its
///   other result
void requireOwnSummary(const std::vector<Study>& studies, const CheckRequest& request) {
  if (!request.summary) return;
  std::vector<fs::path> inputs = request.run.studies;
  if (request.junit) requireOther("--summary", *request.summary, "--junit", *request.junit);
  for (const Study& study : studies) {
    if (!study.check.baseline.empty()) inputs.emplace_back(study.check.baseline);
    if (!study.plan) continue;
    const std::vector<fs::path> more = inputsBeside(*study.plan);
    inputs.insert(inputs.end(), more.begin(), more.end());
  }
  requireNoInput("--summary", *request.summary, inputs);
}

/// Before the study is run, so that its reports can say what became of it.
void readBaselineOf(Study& study, const CheckRequest& request) {
  if (!request.baseline || !study.plan) return;
  const fs::path file = baselineFile(*request.baseline, study.plan->name);
  study.check.baseline = file.string();
  try {
    study.baseline =
        request.updateBaseline ? readFormerReferences(file) : readReferences(file, *study.plan);
  } catch (...) {
    addProblem(study.check, "baseline");
  }
}

Study readOne(const fs::path& file, const CheckRequest& request, std::set<std::string>& names) {
  Study study;
  study.check.name = file.stem().string();
  study.check.file = file.string();
  study.check.command = commandFor(request, study.check.file, {});
  try {
    study::StudyPlan plan = study::readStudyPlan(file, request.run.options);
    study.check.name = plan.name;
    for (const study::StudySpec& step : plan.steps) {
      for (study::Judgement skipped : step.leftOut) {
        skipped.gate.step = step.name;
        study.check.judgements.push_back(std::move(skipped));
      }
    }
    requireNewName(names, file, plan.name);
    requireGates(plan, request);
    study.check.shaders = ownShaders(plan);
    study.plan = std::move(plan);
  } catch (...) {
    addProblem(study.check, "study");
  }
  readBaselineOf(study, request);
  return study;
}

/// @throws UsageError for a chosen method that no study has; where one could not be read, it may be
///   that study's
void requirePaper(const std::vector<Study>& studies, const CheckRequest& request) {
  std::vector<std::string> labels;
  for (const Study& study : studies) {
    if (!study.plan) return;
    appendLabels(*study.plan, labels);
  }
  requirePaperMethods(request.run.paper, labels);
}

/// Studies that have not been judged have an error in it; nothing is told of them to who reads it
/// as it is written.
void writeJunit(const CheckRequest& request, const std::vector<Study>& studies, bool judged) {
  if (!request.junit || (!judged && !keepsContent(*request.junit))) return;
  std::vector<study::CheckRecord> checks;
  for (const Study& study : studies) {
    checks.push_back(study.check);
    if (judged || !study.plan) continue;
    checks.back().problems.push_back(
        {"study", ExitStatus::internal, study.check.file + ": the check did not come to its end"});
  }
  writeTextAtomically(*request.junit, report::junitXml(checks));
}

/// Judges a run by the study's references. What kept the study from having any kept this run from
/// being judged.
void judgeStep(const Study& study, const CheckRequest& request, RunFolders& folders,
               study::StudyRecord& record) {
  if (!request.baseline) return;
  record.baseline = study.check.baseline;
  record.problems.insert(record.problems.end(), study.check.problems.begin(),
                         study.check.problems.end());
  if (request.updateBaseline || !study.baseline) return;
  judgeReferences(record.baseline, *study.baseline, study.plan->steps.front().leftOutMethods,
                  record);
  if (request.run.metricsOnly) return;
  record.referencePictures = report::drawReferencePictures(
      record, folders.of(record.name), pictureFolder(*request.baseline, record.name));
}

/// How many studies a ranking would hold.
std::ptrdiff_t rankedCount(const std::vector<Study>& studies) {
  return std::count_if(studies.begin(), studies.end(),
                       [](const Study& study) { return study.plan && isRanked(*study.plan); });
}

/// Claims and clears the folders of all that can be run: before the first is, so that no summary of
/// an earlier check stays behind where this one ends.
void claimFolders(std::vector<Study>& studies, const CheckRequest& request, RunFolders& folders) {
  for (Study& study : studies) {
    if (!study.plan) continue;
    try {
      folders.claim(*study.plan, request.run.out, !request.run.metricsOnly);
    } catch (...) {
      addProblem(study.check, "study");
    }
  }
  if (rankedCount(studies) > 1) folders.claimRanking(request.run.out);
  folders.clear(request.run.out);
}

/// Makes what every run needs; none where nothing can be run, which is then a problem of each
/// study.
std::unique_ptr<render::GlContext> prepare(std::vector<Study>& studies, const CheckRequest& request,
                                           RunFolders& folders) {
  try {
    const bool drawsPlots = !request.run.metricsOnly;
    if (drawsPlots) report::askGnuplotVersion();  // which it tells while OpenGL starts
    auto gl = std::make_unique<render::GlContext>();
    if (drawsPlots) requirePlots();
    claimFolders(studies, request, folders);
    return gl;
  } catch (...) {
    for (Study& study : studies) {
      if (study.plan) addProblem(study.check, "study");
    }
    return nullptr;
  }
}

/// Runs what can be run.
void runAll(std::vector<Study>& studies, const CheckRequest& request, cache::Cache& cache,
            Records& records) {
  const bool isAny = std::any_of(studies.begin(), studies.end(),
                                 [](const Study& study) { return study.plan.has_value(); });
  if (!isAny) return;
  const std::unique_ptr<render::GlContext> gl = prepare(studies, request, records.folders);
  if (!gl) return;
  std::size_t count = 0;
  for (const Study& study : studies) count += study.plan ? study.plan->steps.size() : 0;
  MeasuredCases cases(*gl, request.run, cache, count);
  for (Study& study : studies) {
    if (!study.plan || !records.folders.holds(study.plan->name)) continue;
    try {
      study.part = runPlan(
          *study.plan, cases, request.run, cache, records,
          [&](study::StudyRecord& record) { judgeStep(study, request, records.folders, record); });
    } catch (...) {
      addProblem(study.check, "study");
    }
  }
}

std::span<const study::StudyRecord> recordsOf(const Study& study, const Records& records) {
  return std::span(records.all).subspan(study.part->first, study.plan->steps.size());
}

/// Each once: a problem of the study is one of all its steps.
void addProblems(study::CheckRecord& check, const std::vector<study::ProblemRecord>& problems) {
  for (const study::ProblemRecord& problem : problems) {
    const bool isThere = std::any_of(
        check.problems.begin(), check.problems.end(),
        [&](const study::ProblemRecord& other) { return other.message == problem.message; });
    if (!isThere) check.problems.push_back(problem);
  }
}

/// Of a refused method, which is told as a problem already.
bool isProblem(const study::StudyRecord& step, const std::string& notice) {
  return std::any_of(
      step.problems.begin(), step.problems.end(),
      [&](const study::ProblemRecord& problem) { return problem.message == notice; });
}

/// Takes over what the runs were judged by: thresholds first, those that were left out after the
/// others, then references.
void collect(Study& study, const CheckRequest& request, const Records& records) {
  study::CheckRecord& check = study.check;
  const std::span<const study::StudyRecord> steps = recordsOf(study, records);
  std::vector<study::Judgement> judgements;
  for (const study::StudyRecord& step : steps) {
    for (const study::TimingRecord& timing : step.timings) check.seconds += timing.seconds;
    judgements.insert(judgements.end(), step.judgements.begin(), step.judgements.end());
    addProblems(check, step.problems);
  }
  check.judgements.insert(check.judgements.begin(), judgements.begin(), judgements.end());
  std::ranges::stable_sort(check.judgements, {}, [](const study::Judgement& judgement) {
    return judgement.gate.origin.index();
  });
  const study::StudySpec& first = study.plan->steps.front();
  // The quick form's values scatter: they say nothing of how tight a limit could be.
  if (!first.quick) check.notices = study::looseThresholds(first.thresholds, steps);
  for (const study::StudyRecord& step : steps) {
    for (const std::string& text : step.notices) {
      if (isProblem(step, text)) continue;
      const std::string where = steps.size() > 1 ? step.name + ": " : "";
      check.notices.push_back({where + text});
    }
  }
  if (request.updateBaseline || !study.baseline) return;
  const std::vector<study::NoticeRecord> notices =
      study::betterThan(study::byOrigin(check.judgements).references);
  check.notices.insert(check.notices.end(), notices.begin(), notices.end());
}

/// Writes the references anew. What goes wrong here is told in the reports too.
void update(Study& study, const CheckRequest& request, cache::Cache& cache, Records& records) {
  const std::span<study::StudyRecord> steps =
      std::span(records.all).subspan(study.part->first, study.plan->steps.size());
  const std::size_t before = study.check.problems.size();
  try {
    const bool isWritten = updateBaseline(study.check.baseline, *study.plan, request.reason,
                                          study.baseline, steps, study.check);
    for (const study::StudyRecord& step : steps) {
      if (!isWritten || !request.baselinePictures) break;
      report::keepReferencePictures(step, request.run.out / step.name,
                                    pictureFolder(*request.baseline, step.name));
    }
  } catch (...) {
    addProblem(study.check, "baseline");
  }
  if (study.check.problems.size() == before) return;
  for (study::StudyRecord& step : steps) step.problems = study.check.problems;
  reportPlan(*study.part, request.run, cache, records);
}

void finish(std::vector<Study>& studies, const CheckRequest& request, cache::Cache& cache,
            Records& records) {
  std::vector<study::StudyMeans> ranked;
  for (Study& study : studies) {
    if (!study.part) continue;
    try {
      collect(study, request, records);
      if (request.updateBaseline) update(study, request, cache, records);
      study::StudyMeans means = meansOf(*study.part, request.run, records);
      if (isRanked(*study.plan)) ranked.push_back(std::move(means));
    } catch (...) {
      addProblem(study.check, "study");
    }
    study.check.command = commandFor(request, study.check.file, faultyMethods(study.check));
  }
  if (ranked.size() > 1) reportRanking(ranked, request.run, records.folders.ranking());
}

void print(const std::vector<study::CheckRecord>& checks, const CheckRequest& request,
           ExitStatus status) {
  std::set<std::string> told;
  for (const study::CheckRecord& check : checks) {
    for (const study::ProblemRecord& problem : check.problems) {
      if (told.insert(problem.message).second) printFailure({problem.status, problem.message});
    }
  }
  for (const study::CheckRecord& check : checks) {
    printText(report::checkTable(check, coloursWanted()) + "\n");
  }
  const std::string notices = report::checkNotices(checks);
  if (!notices.empty()) printText(notices + "\n");
  if (request.github) printUnchanged(report::githubAnnotations(checks));
  printText(report::checkSummary(checks, status, coloursWanted()));
  printLine("Reports: " + request.run.out.string());
}

/// The command that makes what was measured the references.
std::string acceptCommand(const CheckRequest& request) {
  if (!request.baseline || request.updateBaseline) return "";
  std::string command = "gnomon check";
  for (const fs::path& file : request.run.studies) command += " " + shellQuoted(file.string());
  if (request.run.options.quick) command += " --quick";
  return command + " --baseline " + shellQuoted(request.baseline->string()) +
         " --update-baseline --baseline-pictures --reason \"why\"";
}

void writeSummary(const std::vector<study::CheckRecord>& checks, const Records& records,
                  const CheckRequest& request) {
  if (!request.summary) return;
  const std::string text = report::jobSummary(
      checks, report::worstCase(records.all, request.run.out), acceptCommand(request));
  std::ofstream file(*request.summary, std::ios::app | std::ios::binary);
  file << text << std::flush;
  if (!file) throw InputError(request.summary->string() + ": cannot be written");
}

}  // namespace

ExitStatus checkStudies(const CheckRequest& request) {
  requireSense(request);
  std::vector<Study> studies;
  std::set<std::string> names;
  for (const fs::path& file : request.run.studies) {
    studies.push_back(readOne(file, request, names));
  }
  requirePaper(studies, request);
  requireOwnSummary(studies, request);
  writeJunit(request, studies, false);
  Records records;
  const std::unique_ptr<cache::Cache> cache = openCache(request.run.noCache);
  runAll(studies, request, *cache, records);
  finish(studies, request, *cache, records);
  writeJunit(request, studies, true);
  std::vector<study::CheckRecord> checks;
  ExitStatus status = ExitStatus::pass;
  for (const Study& study : studies) {
    checks.push_back(study.check);
    status = std::max(status, study.check.status());
  }
  print(checks, request, status);
  writeSummary(checks, records, request);
  return status;
}

}  // namespace gnomon::cli
