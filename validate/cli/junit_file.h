#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cli/failure.h"

namespace gnomon::cli {

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
