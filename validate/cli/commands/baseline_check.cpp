#include "cli/commands/baseline_check.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <fstream>
#include <string_view>

#include "cli/commands/init_command.h"
#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "common/lists.h"
#include "report/build_server.h"
#include "report/json/results_json.h"

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
  if (!isThere(file)) {
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
  return isThere(file) ? std::optional(report::readBaseline(file)) : std::nullopt;
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

namespace fs = std::filesystem;
namespace {

constexpr std::string_view junitOption = "--junit";

/// Whether a result may stand there: nothing does, or another result.
bool mayReplace(const fs::path& file) {
  if (!keepsContent(file)) return true;
  std::ifstream content(file, std::ios::binary);
  std::string head(4096, '\0');
  content.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(content.gcount()));
  return head.empty() || head.find("<testsuite") != std::string::npos;
}

std::string errorXml(const std::string& command, const Failure& failure) {
  study::CheckRecord check;
  check.name = "gnomon check";
  check.command = command;
  check.problems.push_back({"check", failure.status, failure.message});
  return report::junitXml({&check, 1});
}

}  // namespace

JunitFile::JunitFile(std::span<const char* const> arguments, std::string command)
    : command_(std::move(command)) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view word = arguments[i];
    if (word == "--") break;
    if (word == junitOption && i + 1 < arguments.size()) {
      files_.emplace_back(arguments[i + 1]);
    } else if (word.starts_with(junitOption) && word.substr(junitOption.size()).starts_with('=')) {
      files_.emplace_back(word.substr(junitOption.size() + 1));
    }
  }
  std::erase_if(files_, [](const fs::path& file) { return file.empty(); });
}

void JunitFile::open() const {
  for (const fs::path& file : files_) {
    if (mayReplace(file)) continue;
    throw UsageError(
        fmt::format("--junit {}: a file that is no JUnit XML stands there; it is left as it is",
                    file.string()));
  }
  const std::string text =
      errorXml(command_, {ExitStatus::internal, "the check did not come to its end"});
  for (const fs::path& file : files_) {
    if (keepsContent(file)) writeTextAtomically(file, text);
  }
}

void JunitFile::fail(const Failure& failure) const noexcept {
  for (const fs::path& file : files_) {
    try {
      if (mayReplace(file)) writeTextAtomically(file, errorXml(command_, failure));
    } catch (...) {
      continue;
    }
  }
}

bool keepsContent(const fs::path& file) {
  std::error_code failure;
  const fs::file_status status = fs::status(file, failure);
  return !fs::exists(status) || fs::is_regular_file(status);
}

}  // namespace gnomon::cli
