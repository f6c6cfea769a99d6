#include "cli/baseline_check.h"

#include <fmt/core.h>

#include <optional>

#include "common/atomic_file.h"
#include "common/error.h"
#include "report/baseline_json.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

const char* formName(bool quick) {
  return quick ? "quick" : "full";
}

void requireSameRun(const Baseline& baseline, const BaselineRun& run) {
  if (baseline.study != run.study) {
    throw InputError(
        fmt::format("study: \"{}\" found, \"{}\" expected", baseline.study, run.study));
  }
  if (baseline.quick != run.quick) {
    throw InputError(
        fmt::format("form: references of the {} form found, the check is of the {} one",
                    formName(baseline.quick), formName(run.quick)));
  }
}

bool saysTheSame(const Baseline& a, const Baseline& b) {
  return a.study == b.study && a.quick == b.quick && a.entries == b.entries;
}

}  // namespace

fs::path baselineFile(const fs::path& folder, const std::string& study) {
  return folder / (study + ".json");
}

void checkBaseline(const fs::path& file, const BaselineRun& run, std::span<const StudyRecord> steps,
                   const std::vector<std::string>& leftOut, CheckRecord& check) {
  if (!fs::exists(file)) {
    throw InputError(fmt::format(
        "{}: missing, the references of {} expected; --update-baseline --reason TEXT writes them",
        file.string(), run.study));
  }
  const Baseline baseline = readBaseline(file);
  try {
    requireSameRun(baseline, run);
    std::vector<GateRecord> gates = judgeBaseline(baseline, steps, leftOut);
    const std::vector<NoticeRecord> notices = betterThan(baseline, gates);
    check.gates.insert(check.gates.end(), gates.begin(), gates.end());
    check.notices.insert(check.notices.end(), notices.begin(), notices.end());
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

void updateBaseline(const fs::path& file, const BaselineRun& run,
                    std::span<const StudyRecord> steps, CheckRecord& check) {
  Baseline baseline{run.study, run.quick, steps.front().environment, {}, referenceValues(steps)};
  std::optional<Baseline> before;
  if (fs::exists(file)) before = readBaseline(file);
  if (check.status() != ExitStatus::pass) {
    check.notices.push_back(
        {fmt::format("{} left as it is: the check has not passed", file.string())});
    return;
  }
  if (baseline.entries.empty()) {
    throw InputError(
        fmt::format("{}: no value is defined that could be a reference", file.string()));
  }
  if (before && saysTheSame(*before, baseline)) {
    check.notices.push_back({fmt::format("{} left as it is: no value has changed", file.string())});
    return;
  }
  if (before) baseline.history = before->history;
  baseline.history.push_back(
      {run.reason, baseline.environment.gnomonVersion, baseline.environment.commit});
  writeTextAtomically(file, baselineJson(baseline));
  check.notices.push_back(
      {fmt::format("{} written: {} references", file.string(), baseline.entries.size())});
}

}  // namespace gnomon
