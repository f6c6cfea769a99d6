#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/files/file_lock.h"
#include "report/run_folder.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// The folder of a study, a sweep or a step of one.
extern const report::FolderKind studyFolderKind;

/// Locks a folder of results for this process, and creates it where it is not there.
/// @throws InputError where another process holds it, and as RunFolder
FileLock lockFolder(const report::RunFolder& folder);

/// Every file that a study's runs read, without the study's own.
/// @throws InputError as inputFiles
std::vector<std::filesystem::path> inputsBeside(const study::StudyPlan& plan);

/// The folders of results that a command writes: `out/NAME` of each study and `out/NAME/VALUE` of a
/// sweep's values. First all are claimed, then all are cleared, before the first study is run: a
/// run that is killed leaves no summary of an earlier one that it did not reach.
class RunFolders {
 public:
  /// Locks a study's folders for this process; removes nothing.
  /// @throws InputError where another process writes there, a file of somebody else's stands in the
  ///   place of a summary or of the study's copy, or the study reads what an earlier run left there
  /// @param withSteps  whether a sweep's steps have folders
  void claim(const study::StudyPlan& plan, const std::filesystem::path& out, bool withSteps = true);
  /// Likewise the ranking's files in `out`.
  void claimRanking(const std::filesystem::path& out);

  /// Removes what earlier runs left in the claimed folders, and in `out` a ranking that tells of
  /// them. What a study is read from stays, and the folders of the steps and studies that are
  /// `kept`.
  void clear(const std::filesystem::path& out, const std::set<std::string>& kept = {});

  /// Whether a study's or a step's folder has been claimed.
  [[nodiscard]] bool holds(const std::string& name) const { return claimed_.contains(name); }
  [[nodiscard]] report::RunFolder& of(const std::string& name) { return claimed_.at(name).folder; }
  /// Once it is claimed.
  [[nodiscard]] report::RunFolder& ranking() { return ranking_.at(0); }

 private:
  struct Claimed {
    report::RunFolder folder;
    std::string copy;                     ///< name of the study's copy
    std::vector<std::string> subfolders;  ///< of a sweep's values
  };
  void clearOldRanking(const std::filesystem::path& out);

  std::map<std::string, Claimed> claimed_;      ///< by study or step
  std::vector<std::filesystem::path> studies_;  ///< that are run: never removed
  std::vector<report::RunFolder> ranking_;      ///< none or one
  std::vector<FileLock> locks_;
};

}  // namespace gnomon::cli
