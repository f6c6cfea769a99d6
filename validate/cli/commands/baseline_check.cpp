#include "cli/commands/baseline_check.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "cli/repository_commit.h"
#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "common/lists.h"
#include "report/json/baseline_json.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

const char* formName(bool quick) {
  return quick ? "quick" : "full";
}

bool isQuick(const study::StudyPlan& plan) {
  return plan.steps.front().quick;
}

void requireSameRun(const study::Baseline& baseline, const study::StudyPlan& plan) {
  if (baseline.study != plan.name) {
    throw InputError(
        fmt::format("study: \"{}\" found, \"{}\" expected", baseline.study, plan.name));
  }
  if (baseline.quick != isQuick(plan)) {
    throw InputError(
        fmt::format("form: references of the {} form found, the check is of the {} one",
                    formName(baseline.quick), formName(isQuick(plan))));
  }
  std::vector<std::string> steps;
  for (const study::StudySpec& step : plan.steps) steps.push_back(step.name);
  for (const study::Gate& gate : baseline.gates) {
    // A value of a step that is not run could never be judged.
    if (contains(steps, gate.step)) continue;
    throw InputError(fmt::format("values.study: \"{}\" found, the study has {}", gate.step,
                                 fmt::join(steps, ", ")));
  }
}

bool saysTheSame(const study::Baseline& a, const study::Baseline& b) {
  return a.study == b.study && a.quick == b.quick && a.gates == b.gates;
}

}  // namespace

fs::path baselineFile(const fs::path& folder, const std::string& study) {
  return folder / (study + ".json");
}

fs::path pictureFolder(const fs::path& folder, const std::string& step) {
  return folder / "pictures" / step;
}

study::Baseline readReferences(const fs::path& file, const study::StudyPlan& plan) {
  if (!pathExists(file)) {
    throw InputError(fmt::format(
        "{}: missing, the references of {} expected; --update-baseline --reason TEXT writes them",
        file.string(), plan.name));
  }
  study::Baseline baseline = report::readBaseline(file);
  try {
    requireSameRun(baseline, plan);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
  return baseline;
}

void judgeReferences(const fs::path& file, const study::Baseline& baseline,
                     const std::vector<std::string>& leftOut, study::StudyRecord& record) {
  try {
    const std::vector<study::Judgement> references =
        study::judgeBaseline(baseline, record, leftOut);
    record.judgements.insert(record.judgements.end(), references.begin(), references.end());
  } catch (const InputError& error) {
    record.problems.push_back(
        {"baseline", error.status(), fmt::format("{}: {}", file.string(), error.what())});
  }
}

std::optional<study::Baseline> readFormerReferences(const fs::path& file) {
  return pathExists(file) ? std::optional(report::readBaseline(file)) : std::nullopt;
}

bool updateBaseline(const fs::path& file, const study::StudyPlan& plan, const std::string& reason,
                    const std::optional<study::Baseline>& former,
                    std::span<const study::StudyRecord> steps, study::CheckRecord& check) {
  study::Baseline baseline{
      plan.name, isQuick(plan), steps.front().environment, {}, study::referenceGates(steps)};
  if (check.status() != ExitStatus::pass) {
    check.notices.push_back(
        {fmt::format("{} left as it is: the check has not passed", file.string())});
    return false;
  }
  if (baseline.gates.empty()) {
    throw InputError(
        fmt::format("{}: no value is defined that could be a reference", file.string()));
  }
  if (former && saysTheSame(*former, baseline)) {
    check.notices.push_back({fmt::format("{} left as it is: no value has changed", file.string())});
    return true;
  }
  if (former) baseline.history = former->history;
  baseline.history.push_back({reason, baseline.environment.gnomonVersion,
                              baseline.environment.commit, repositoryCommit(file.parent_path())});
  writeTextAtomically(file, report::baselineJson(baseline));
  check.notices.push_back(
      {fmt::format("{} written: {} references", file.string(), baseline.gates.size())});
  return true;
}

}  // namespace gnomon::cli
