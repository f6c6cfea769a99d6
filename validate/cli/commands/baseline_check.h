#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/output.h"
#include "study/judge/gates.h"
#include "study/record/cases.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// The file of a study's references in a folder: `NAME.json`.
std::filesystem::path baselineFile(const std::filesystem::path& folder, const std::string& study);

/// The folder of the pictures that are kept with the references of a study, or of a sweep's step:
/// `pictures/NAME`.
std::filesystem::path pictureFolder(const std::filesystem::path& folder, const std::string& step);

/// The references of a study, read before it is run.
/// @throws InputError naming the file: it is missing or no baseline, or is of another study or
///   form, or holds values of steps that the study does not have
study::Baseline readReferences(const std::filesystem::path& file, const study::StudyPlan& plan);

/// Judges one run by its part of the references: its gates, and what kept it from being judged.
/// @param leftOut  labels of the methods that the run takes no part of
void judgeReferences(const std::filesystem::path& file, const study::Baseline& baseline,
                     const std::vector<std::string>& leftOut, study::StudyRecord& record);

/// The references that an update replaces; none where there is no file.
/// @throws InputError for a file that is no baseline, so that its history is not lost
std::optional<study::Baseline> readFormerReferences(const std::filesystem::path& file);

/// Writes a run's values as references, with the reason after those of the file that was there, and
/// tells of it in a notice. Leaves the file alone where the check has not passed, and where every
/// value is the one that it holds: its reasons are those of its values.
/// @param reason  why it is written
/// @param former  what the file holds
/// @return whether the references are now this run's
/// @throws InputError where the run has no value to write
bool updateBaseline(const std::filesystem::path& file, const study::StudyPlan& plan,
                    const std::string& reason, const std::optional<study::Baseline>& former,
                    std::span<const study::StudyRecord> steps, study::CheckRecord& check);

/// The JUnit file of a command line, from before anything else happens. Until a check has come to
/// its end the file holds an error: no process that is killed, and no error of usage, leaves the
/// pass of an earlier check there.
class JunitFile {
 public:
  /// Finds `--junit FILE` and `--junit=FILE` among arguments that nobody has understood yet;
  /// several, if that is what stands there.
  JunitFile(std::span<const char* const> arguments, std::string command);

  /// Writes that the check did not come to its end.
  /// @throws UsageError for a file that holds something else than JUnit XML, so that a mistyped
  ///   command replaces no study; InputError for one that cannot be written
  void open() const;

  /// Writes why there is no result, where `open` found that it may. What prevents that too is not
  /// told: there is one failure already.
  void fail(const Failure& failure) const noexcept;

 private:
  std::vector<std::filesystem::path> files_;
  std::string command_;
};

/// Whether a file can hold a result before there is one: it is a regular file, or none yet. What
/// somebody reads as it is written, a device or a pipe, gets the result alone.
bool keepsContent(const std::filesystem::path& file);

}  // namespace gnomon::cli
