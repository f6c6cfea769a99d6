#include "cli/run_folders.h"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>

#include "common/error.h"
#include "study/spec/resolved_study.h"
#include "study/spec/study_inputs.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

const report::FolderKind rankingKind{
    "ranking.json", {"ranking.csv", "ranking.md", "ranking.html"}, "ranking.txt"};

/// The part of a step's name that is its folder in its sweep's, with a slash: "0.5/".
std::string subfolderOf(const std::string& step) {
  return step.substr(step.find('/') + 1) + "/";
}

}  // namespace

const report::FolderKind studyFolderKind{"summary.json", {"report.html"}};

std::vector<fs::path> inputsBeside(const study::StudyPlan& plan) {
  std::vector<fs::path> inputs = study::inputFiles(plan.steps.front());
  std::erase(inputs, plan.steps.front().file);
  return inputs;
}

FileLock lockFolder(const report::RunFolder& folder) {
  std::error_code failure;
  fs::create_directories(folder.path(), failure);
  if (failure) {
    throw InputError(
        fmt::format("{}: cannot create the folder: {}", folder.path().string(), failure.message()));
  }
  FileLock lock(folder.listFile(), FileLock::Wait::no);
  if (lock.state() == FileLock::State::elsewhere) {
    throw InputError(fmt::format(
        "{}: another run is writing into this folder; wait for its end, or choose another --out",
        folder.path().string()));
  }
  if (lock.state() == FileLock::State::noLocks) {
    fmt::print(stderr,
               "gnomon: warning: {}: its file system has no locks: a second run into it at the "
               "same time would mix with this one\n",
               folder.path().string());
  }
  return lock;
}

void RunFolders::claim(const study::StudyPlan& plan, const fs::path& out, bool withSteps) {
  std::map<std::string, Claimed> found;
  const std::vector<fs::path> inputs = inputsBeside(plan);
  const auto add = [&](const std::string& name) {
    const std::string copy = study::studyCopyName(name);
    study::requireCopyOrNothing(out / name / copy);
    report::RunFolder folder(out / name, studyFolderKind);
    folder.requireNone(inputs);
    found.insert_or_assign(name, Claimed{std::move(folder), copy, {}});
  };
  add(plan.name);
  // Once more: while it was not locked another run may have changed it.
  locks_.push_back(lockFolder(found.at(plan.name).folder));
  add(plan.name);
  for (const study::StudySpec& step : plan.steps) {
    if (step.name == plan.name || !withSteps) continue;
    add(step.name);
    found.at(plan.name).subfolders.push_back(subfolderOf(step.name));
  }
  claimed_.merge(found);
  studies_.push_back(plan.steps.front().file);
}

void RunFolders::claimRanking(const fs::path& out) {
  locks_.push_back(lockFolder(report::RunFolder(out, rankingKind)));
  ranking_.emplace_back(out, rankingKind);
}

void RunFolders::clear(const fs::path& out, const std::set<std::string>& kept) {
  clearOldRanking(out);
  // With a sweep's folder those of its values would go.
  const auto stays = [&](const auto& entry) {
    const std::string below = entry.first + "/";
    const auto next = kept.lower_bound(below);
    return kept.contains(entry.first) || (next != kept.end() && next->starts_with(below));
  };
  for (auto& entry : claimed_) {
    if (!kept.contains(entry.first)) entry.second.folder.removeIndex();
  }
  for (auto& entry : claimed_) {
    Claimed& claimed = entry.second;
    if (!stays(entry)) claimed.folder.clear(studies_);
    std::error_code failure;
    if (fs::exists(claimed.folder.path() / claimed.copy, failure)) claimed.folder.add(claimed.copy);
    for (const std::string& subfolder : claimed.subfolders) claimed.folder.add(subfolder);
  }
}

void RunFolders::clearOldRanking(const fs::path& out) {
  if (!ranking_.empty()) {
    ranking().clear();
    return;
  }
  report::RunFolder old(out, rankingKind);
  const bool tellsOfOurs = std::any_of(claimed_.begin(), claimed_.end(), [&](const auto& claimed) {
    return old.names(claimed.first + "/");
  });
  if (!tellsOfOurs) return;
  // Whoever holds it has removed it already, and ranks none of the studies that are locked here.
  const FileLock lock(old.listFile(), FileLock::Wait::no);
  if (lock.state() != FileLock::State::elsewhere) old.remove();
}

}  // namespace gnomon::cli
