#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <set>

namespace gnomon {

/// What a signal that ends the process must not leave behind.
struct Unfinished {
  std::set<std::filesystem::path> files;  ///< and folders, with all that is in them: removed
  std::set<pid_t> helpers;                ///< child processes, not yet waited for: killed
};

/// Changes the process's list of unfinished things. No signal that `cleanUpOnSignals` handles ends
/// the process meanwhile: a file that `change` both creates and adds cannot be left behind.
/// Any thread may call it; `change` must not call it again.
void changeUnfinished(const std::function<void(Unfinished&)>& change);

/// From now on SIGINT, SIGTERM and SIGHUP remove the unfinished files, kill the helpers, and end
/// the process with the status 128 + the signal's number. A signal that is ignored when this is
/// called stays ignored, as under nohup. To be called once, before the first other thread starts:
/// all threads block these signals, and one waits for them, so that the work is not done inside a
/// signal handler. A child process inherits the block unless it is started with a mask of its own
/// (posix_spawnattr_setsigmask).
void cleanUpOnSignals();

}  // namespace gnomon
