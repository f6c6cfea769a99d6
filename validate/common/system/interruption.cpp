#include "common/system/interruption.h"

#include <fmt/core.h>
#include <signal.h>
#include <unistd.h>

#include <cstring>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>

namespace gnomon {
namespace {

struct Guarded {
  std::mutex mutex;
  Unfinished unfinished;
};

/// Never destroyed: the waiting thread may use it to the process's very end.
Guarded& guarded() {
  static auto* const all = new Guarded;
  return *all;
}

[[noreturn]] void endBy(int signal) {
  Guarded& all = guarded();
  // Never released: nothing is begun any more.
  all.mutex.lock();
  for (const std::filesystem::path& file : all.unfinished.files) {
    std::error_code ignored;
    std::filesystem::remove_all(file, ignored);
  }
  for (const pid_t helper : all.unfinished.helpers) ::kill(helper, SIGKILL);
  const char* name = ::sigabbrev_np(signal);
  const std::string line = fmt::format("{}gnomon: ended by SIG{}\n",
                                       ::isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "", name);
  if (::write(STDERR_FILENO, line.data(), line.size()) < 0) {
    // Nobody is there to be told.
  }
  ::_exit(128 + signal);
}

bool isIgnored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void changeUnfinished(const std::function<void(Unfinished&)>& change) {
  Guarded& all = guarded();
  const std::lock_guard lock(all.mutex);
  change(all.unfinished);
}

void cleanUpOnSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (!isIgnored(signal)) sigaddset(&signals, signal);
  }
  sigset_t before;
  pthread_sigmask(SIG_BLOCK, &signals, &before);
  try {
    std::thread([signals] {
      int signal = 0;
      while (sigwait(&signals, &signal) != 0) {
      }
      endBy(signal);
    }).detach();
  } catch (const std::system_error&) {
    // No thread can be had: a signal ends the process as it always did.
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
}

}  // namespace gnomon
