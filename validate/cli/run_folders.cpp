#include "cli/run_folders.h"

#include <algorithm>
#include <utility>

#include "study/spec/resolved_study.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

const report::FolderKind rankingKind{
    "ranking.json", {"ranking.csv", "ranking.md", "ranking.html"}, "ranking.txt", true};

}  // namespace

const report::FolderKind studyFolderKind{"summary.json", {"report.html"}};

std::vector<fs::path> inputsBeside(const study::StudyPlan& plan) {
  std::vector<fs::path> inputs = study::inputFiles(plan.steps.front());
  std::erase(inputs, plan.steps.front().file);
  return inputs;
}

void RunFolders::claim(const study::StudyPlan& plan, const fs::path& out, bool withSteps) {
  const std::vector<fs::path> inputs = inputsBeside(plan);
  const auto checked = [&](const std::string& name) {
    study::requireCopyOrNothing(out / name / study::studyCopyName(name));
    report::RunFolder folder(out / name, studyFolderKind);
    folder.requireNone(inputs);
    return folder;
  };
  report::RunFolder folder = checked(plan.name);
  std::vector<std::string> steps;
  for (const study::StudySpec& step : plan.steps) {
    if (step.name == plan.name || !withSteps) continue;
    (void)checked(step.name);
    steps.push_back(step.name);
  }
  folders_.emplace(plan.name, std::move(folder));
  steps_.emplace(plan.name, std::move(steps));
}

void RunFolders::claimRanking(const fs::path& out) {
  ranking_.emplace(out, rankingKind);
}

void RunFolders::clear(const fs::path& out) {
  report::RunFolder old(out, rankingKind);
  const bool tellsOfOurs = std::any_of(folders_.begin(), folders_.end(), [&](const auto& folder) {
    return old.names(folder.first + "/");
  });
  if (ranking_) {
    ranking_->clear();
  } else if (tellsOfOurs) {
    old.clear();
  }
  for (const auto& [study, steps] : steps_) {
    report::RunFolder& folder = folders_.at(study);
    folder.clear();
    for (const std::string& step : steps) {
      folders_.emplace(step, report::RunFolder(folder, step.substr(study.size() + 1)));
    }
  }
}

}  // namespace gnomon::cli
