#include "cli/shards/shard_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "cli/case_source.h"
#include "cli/commands/cache_command.h"
#include "cli/failure.h"
#include "cli/output.h"
#include "cli/paper_request.h"
#include "cli/plan_runs.h"
#include "cli/run_plans.h"
#include "cli/shards/case_list.h"
#include "cli/shards/kept_case.h"
#include "cli/study_plans.h"
#include "common/files/input_file.h"
#include "common/text/sha256.h"
#include "report/plots/gnuplot.h"
#include "report/text/number_text.h"
#include "study/run/scene/environment.h"
#include "study/spec/resolved_study.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

const report::FolderKind shardKind{"", {manifestFile}, "shard.txt"};

void refuseStreams(const RunRequest& request) {
  for (const fs::path& study : request.studies) {
    if (!isGivenStream(study)) continue;
    throw UsageError(fmt::format(
        "--shard: the study {} is a stream; a file expected, which merge can read again",
        study.string()));
  }
}

/// The plans that have some of the cases, with these alone, whole.
std::vector<study::StudyPlan> readParts(const RunRequest& request,
                                        const std::vector<CasePlace>& cases) {
  std::map<std::size_t, std::set<std::size_t>> steps;
  for (const CasePlace& place : cases) steps[place.plan].insert(place.step);
  std::vector<study::StudyPlan> parts;
  parts.reserve(steps.size());
  for (const auto& [plan, wanted] : steps) {
    // A lambda can't capture a part of a structured binding in clang 14.
    const auto isWanted = [&kept = wanted](std::size_t step) { return kept.contains(step); };
    parts.push_back(study::readStudyPlan(request.studies[plan], request.options, isWanted));
  }
  return parts;
}

ShardManifest manifestOf(const RunRequest& request, const std::vector<study::StudyPlan>& outlines,
                         const std::vector<study::StudyPlan>& parts) {
  ShardManifest manifest{study::programVersion(),
                         study::programCommit(),
                         *request.shard,
                         withoutOption(request.arguments, "--shard"),
                         {},
                         {}};
  for (const study::StudyPlan& plan : outlines) manifest.studies.push_back(manifestStudy(plan));
  for (const study::StudyPlan& part : parts) {
    for (const study::StudySpec& step : part.steps) {
      manifest.cases.push_back({step.name, inStudy(step, [&] { return caseHash(step); })});
    }
  }
  return manifest;
}

/// What an earlier run of a shard left in a folder; none where there is none, or it is damaged.
std::optional<ShardManifest> formerManifest(const fs::path& out) {
  try {
    return readManifest(out);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// Whether two manifests ask for the same.
bool asksForTheSame(ShardManifest a, ShardManifest b) {
  for (ShardManifest* manifest : {&a, &b}) {
    for (auto& one : manifest->cases) one.isWhole = false;
  }
  return a.version == b.version && a.commit == b.commit && a.shard == b.shard &&
         settingsOf(a) == settingsOf(b) && a.studies == b.studies && a.cases == b.cases;
}

/// One shard being run.
class ShardRun {
 public:
  ShardRun(const RunRequest& request, const std::vector<study::StudyPlan>& outlines)
      : request_(request),
        parts_(readParts(request, casesOf(outlines, *request.shard))),
        manifest_(manifestOf(request, outlines, parts_)),
        allCases_(allCases(outlines).size()),
        folder_(request.out, shardKind),
        lock_(lockFolder(folder_)) {
    folder_ = report::RunFolder(request.out, shardKind);  // as it is now that it is locked
  }

  ExitStatus run() {
    takeOver();
    if (!manifest_.isWhole()) measureAll();
    folder_.write(manifestFile, manifestText(manifest_));
    folder_.finish();
    failures_.print();
    report();
    return std::max(failures_.status(), worst_);
  }

 private:
  /// Keeps what an earlier run of the same shard has done, and clears the rest.
  void takeOver() {
    const std::optional<ShardManifest> former = formerManifest(request_.out);
    if (former && former->shard != manifest_.shard) {
      throw InputError(fmt::format("{}: holds shard {} of another division; another --out expected",
                                   request_.out.string(), shardText(former->shard)));
    }
    std::set<std::string> kept;
    if (former && asksForTheSame(*former, manifest_)) {
      for (auto& one : manifest_.cases) {
        const auto found = findCase(request_.out / one.name, one.sha256);
        one.isWhole = found.has_value();
        if (found) worst_ = std::max(worst_, worstProblem({found->record}));
        if (found) kept.insert(one.name);
      }
    }
    for (const study::StudyPlan& part : parts_) records_.folders.claim(part, request_.out);
    records_.folders.clear(request_.out, kept);
    if (!former) folder_.clear();
    folder_.write(manifestFile, manifestText(manifest_));
  }

  void measureAll() {
    if (!request_.metricsOnly) report::askGnuplotVersion();  // which it tells while OpenGL starts
    const render::GlContext gl;
    if (!request_.metricsOnly) requirePlots();
    const std::unique_ptr<cache::Cache> cache = openCache(request_.noCache);
    MeasuredCases cases(gl, request_, *cache, manifest_.cases.size());
    auto next = manifest_.cases.begin();
    for (const study::StudyPlan& part : parts_) {
      for (const study::StudySpec& step : part.steps) {
        ShardManifest::Case& one = *next++;
        if (one.isWhole) continue;
        one.isWhole = failures_.attempt([&] { measure(part, step, one.sha256, cases, *cache); });
        if (one.isWhole) printLine(one.name);
        forgetRecords();
      }
    }
  }

  void measure(const study::StudyPlan& part, const study::StudySpec& step, const std::string& hash,
               CaseSource& cases, cache::Cache& cache) {
    cases.prepare(step);
    report::RunFolder& folder = records_.folders.of(step.name);
    std::set<std::string> before = folder.names();
    before.insert(study::studyCopyName(step.name));  // which tells where it lies
    const auto keep = [&](study::StudyRecord& record) {
      KeptCase kept{record, filesSince(folder, before)};
      keepCase(folder, hash, kept);
    };
    runStep(part, step, cases, request_, cache, records_, keep);
    worst_ = std::max(worst_, worstProblem(records_.all));
  }

  void forgetRecords() { records_.all.clear(); }

  void report() const {
    const auto whole = std::count_if(manifest_.cases.begin(), manifest_.cases.end(),
                                     [](const auto& one) { return one.isWhole; });
    printLine(fmt::format("Shard {}: {} of its {} cases are whole in {} ({} in all shards)",
                          shardText(manifest_.shard),
                          report::groupedText(static_cast<std::uint64_t>(whole)),
                          report::groupedText(manifest_.cases.size()), request_.out.string(),
                          report::groupedText(allCases_)));
  }

  const RunRequest& request_;
  std::vector<study::StudyPlan> parts_;
  ShardManifest manifest_;
  std::size_t allCases_;
  report::RunFolder folder_;
  FileLock lock_;
  Records records_;
  Failures failures_;
  ExitStatus worst_ = ExitStatus::pass;
};

}  // namespace

ShardManifest::Study manifestStudy(const study::StudyPlan& plan) {
  const study::StudySpec& first = plan.steps.front();
  return {first.file.string(), plan.name, sha256(first.text)};
}

ExitStatus runShard(const RunRequest& request) {
  refuseStreams(request);
  const std::vector<study::StudyPlan> outlines = readOutlines(request.studies, request.options);
  requirePaperMethods(request.paper, outlines);
  return ShardRun(request, outlines).run();
}

}  // namespace gnomon::cli
