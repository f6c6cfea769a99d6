#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

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

/// A program to start as a process of its own.
struct ChildProgram {
  std::vector<std::string> words;  ///< its name, looked for on the PATH, and its arguments
  /// Its variables, "NAME=value"; without a list this process's own.
  std::optional<std::vector<std::string>> variables = {};
  std::filesystem::path folder = {};  ///< where it runs; empty for this process's own
  std::FILE* in = nullptr;            ///< its standard input; without one it has none
  std::FILE* out = nullptr;           ///< its standard output, to be open
  std::FILE* err = nullptr;           ///< its standard error, to be open
};

/// What came of a start.
struct ChildStart {
  pid_t process = -1;
  int failure = 0;  ///< the number of the system's error; 0 where the program runs
};

/// Starts a program. A signal that ends this process (`cleanUpOnSignals`) kills it until its end
/// has been awaited. It dies itself of the signals that this process ignores or blocks, so that
/// what it could not write whole does not pass for whole.
ChildStart startChild(const ChildProgram& program);

/// The state of a started program as waitpid tells it, which frees its number. Of a process that is
/// no child of this one: the exit status 127.
/// @param isAwaited  waits for its end; else nothing is returned while it runs
std::optional<int> endOfChild(pid_t process, bool isAwaited);

/// What a file holds, from its beginning.
std::string contentOf(std::FILE* file);

/// Bounds on a process.
struct ProcessLimits {
  double bytes;    ///< of memory that it holds
  double seconds;  ///< of all its threads together, and ten times as long by the clock
};

/// How a process ended.
enum class ProcessEnd {
  exited,      ///< by itself, with a status
  crashed,     ///< by a signal
  outgrew,     ///< ended for more memory than its limit
  overstayed,  ///< ended for more time than its limit
};

struct ProcessOutcome {
  ProcessEnd end = ProcessEnd::exited;
  int code = 0;  ///< the exit status, or the signal's number
};

/// Runs `ownProgram` with other arguments, without input and output, and waits for its end: for
/// what may crash or take all memory in a library. The child is to call `beChildProcess`.
/// @throws InternalError where it cannot be started
ProcessOutcome runSelf(const std::vector<std::string>& arguments, const ProcessLimits& limits);

/// In such a process, at its start: it ends when its parent does, or has taken so many seconds of
/// the processor, and leaves no core file.
void beChildProcess(const ProcessLimits& limits);

}  // namespace gnomon
