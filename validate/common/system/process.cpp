#include "common/system/process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <mutex>
#include <system_error>
#include <thread>

#include "common/error.h"
#include "common/system/own_files.h"

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

namespace {

/// Signals as a program finds them that a shell starts.
class SignalsAsUsual {
 public:
  SignalsAsUsual() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int number : {SIGPIPE, SIGXFSZ}) sigaddset(&signals, number);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    sigset_t noSignal;
    sigemptyset(&noSignal);
    posix_spawnattr_setsigmask(&attributes_, &noSignal);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  }
  ~SignalsAsUsual() { posix_spawnattr_destroy(&attributes_); }
  SignalsAsUsual(const SignalsAsUsual&) = delete;
  SignalsAsUsual& operator=(const SignalsAsUsual&) = delete;
  [[nodiscard]] const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

/// The folder and the standard streams of a program.
class Surroundings {
 public:
  explicit Surroundings(const ChildProgram& program) {
    posix_spawn_file_actions_init(&actions_);
    if (!program.folder.empty()) {
      posix_spawn_file_actions_addchdir_np(&actions_, program.folder.c_str());
    }
    if (program.in == nullptr) {
      posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    } else {
      posix_spawn_file_actions_adddup2(&actions_, fileno(program.in), STDIN_FILENO);
    }
    posix_spawn_file_actions_adddup2(&actions_, fileno(program.out), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, fileno(program.err), STDERR_FILENO);
  }
  ~Surroundings() { posix_spawn_file_actions_destroy(&actions_); }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// Texts as the system takes them, ended by a null.
std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

ChildStart startChild(const ChildProgram& program) {
  std::vector<std::string> words = program.words;
  std::vector<std::string> variables = program.variables.value_or(std::vector<std::string>());
  const std::vector<char*> arguments = pointersTo(words);
  const std::vector<char*> environment = pointersTo(variables);
  const Surroundings surroundings(program);
  const SignalsAsUsual signals;
  ChildStart started;
  // Together, so that no signal ends this process between the start and the entry in the list.
  changeUnfinished([&](Unfinished& unfinished) {
    started.failure =
        posix_spawnp(&started.process, arguments.front(), surroundings.get(), signals.get(),
                     arguments.data(), program.variables ? environment.data() : environ);
    if (started.failure == 0) unfinished.helpers.insert(started.process);
  });
  return started;
}

std::optional<int> endOfChild(pid_t process, bool isAwaited) {
  siginfo_t ended{};
  const int options = WEXITED | WNOWAIT | (isAwaited ? 0 : WNOHANG);
  int failed = 0;
  do {
    failed = waitid(P_PID, static_cast<id_t>(process), &ended, options);
  } while (failed != 0 && errno == EINTR);
  if (failed == 0 && ended.si_pid == 0) return std::nullopt;
  int state = W_EXITCODE(127, 0);  // stays where there is no such process
  // Together, so that its number is never another process's while it is in the list.
  changeUnfinished([&](Unfinished& unfinished) {
    ::waitpid(process, &state, 0);
    unfinished.helpers.erase(process);
  });
  return state;
}

std::string contentOf(std::FILE* file) {
  std::rewind(file);
  std::string text;
  std::array<char, 65536> buffer{};
  while (const std::size_t read = std::fread(buffer.data(), 1, buffer.size(), file)) {
    text.append(buffer.data(), read);
  }
  return text;
}

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
