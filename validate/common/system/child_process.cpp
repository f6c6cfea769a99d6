#include "common/system/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "common/system/interruption.h"

namespace gnomon {
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

}  // namespace gnomon
