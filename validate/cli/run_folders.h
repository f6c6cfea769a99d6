#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "report/run_folder.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// The folder of a study, a sweep or a step of one.
extern const report::FolderKind studyFolderKind;

/// Every file that a study's runs read, without the study's own.
/// @throws InputError as inputFiles
std::vector<std::filesystem::path> inputsBeside(const study::StudyPlan& plan);

/// The folders of results that a command writes: `out/NAME` of each study and, in it, `NAME/VALUE`
/// of a sweep's values. First all are claimed, then all are cleared, before the first study is run:
/// a run that is killed leaves no summary of an earlier one that it did not reach.
class RunFolders {
 public:
  /// Changes nothing.
  /// @throws InputError where a file of somebody else's stands in the place of a summary or of the
  ///   study's copy, or the study reads what an earlier run left there
  /// @param withSteps  whether a sweep's steps have folders
  void claim(const study::StudyPlan& plan, const std::filesystem::path& out, bool withSteps = true);
  /// Likewise the ranking's files in `out`.
  void claimRanking(const std::filesystem::path& out);

  /// Begins the claimed folders, and removes in `out` a ranking that tells of them.
  void clear(const std::filesystem::path& out);

  /// Whether a study's or a step's folder has been claimed.
  [[nodiscard]] bool holds(const std::string& name) const { return folders_.contains(name); }
  [[nodiscard]] report::RunFolder& of(const std::string& name) { return folders_.at(name); }
  /// Once it is claimed.
  [[nodiscard]] report::RunFolder& ranking() { return ranking_.value(); }

 private:
  std::map<std::string, report::RunFolder> folders_;       ///< by study; when cleared by step too
  std::map<std::string, std::vector<std::string>> steps_;  ///< of each sweep: its steps' names
  std::optional<report::RunFolder> ranking_;
};

}  // namespace gnomon::cli
