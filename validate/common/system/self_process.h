#pragma once

#include <string>
#include <vector>

namespace gnomon {

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
