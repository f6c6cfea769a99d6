#include "common/system/self_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <thread>

#include "common/error.h"
#include "common/system/own_files.h"

namespace gnomon {
namespace {

using Clock = std::chrono::steady_clock;

pid_t start(std::vector<std::string> words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const std::string program = ownProgram().string();
  const int failure =
      posix_spawn(&process, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) {
    throw InternalError(fmt::format("{} cannot be started: {}", program, std::strerror(failure)));
  }
  return process;
}

double residentBytes(pid_t process) {
  std::ifstream file(fmt::format("/proc/{}/statm", process));
  double whole = 0;
  double residentPages = 0;
  file >> whole >> residentPages;
  return residentPages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

int endedBy(pid_t process) {
  int state = 0;
  kill(process, SIGKILL);
  waitpid(process, &state, 0);
  return SIGKILL;
}

ProcessOutcome outcomeOf(int state) {
  if (WIFEXITED(state)) return {ProcessEnd::exited, WEXITSTATUS(state)};
  const int signal = WTERMSIG(state);
  return {signal == SIGXCPU ? ProcessEnd::overstayed : ProcessEnd::crashed, signal};
}

}  // namespace

ProcessOutcome runSelf(const std::vector<std::string>& arguments, const ProcessLimits& limits) {
  // Short, since memory may grow by gigabytes a second.
  constexpr auto pause = std::chrono::milliseconds(5);
  std::vector<std::string> words = {"gnomon"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const pid_t process = start(std::move(words));
  const auto end = Clock::now() + std::chrono::duration<double>(10 * limits.seconds);
  int state = 0;
  while (waitpid(process, &state, WNOHANG) == 0) {
    if (residentBytes(process) > limits.bytes) return {ProcessEnd::outgrew, endedBy(process)};
    if (Clock::now() > end) return {ProcessEnd::overstayed, endedBy(process)};
    std::this_thread::sleep_for(pause);
  }
  return outcomeOf(state);
}

void beChildProcess(const ProcessLimits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const auto seconds = static_cast<rlim_t>(std::ceil(limits.seconds));
  const rlimit time{seconds, seconds + 5};
  setrlimit(RLIMIT_CPU, &time);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
}

}  // namespace gnomon
