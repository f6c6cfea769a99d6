#include "viewer/window/film.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/files/disk_sync.h"
#include "common/system/interruption.h"
#include "common/text/one_line.h"
#include "model/light_path.h"

namespace gnomon::app {
namespace fs = std::filesystem;
namespace {

/// Signals as a program finds them that a shell starts: it dies of an interruption.
class UsualSignals {
 public:
  UsualSignals() {
    sigset_t none;
    sigemptyset(&none);
    sigset_t ignored;
    sigemptyset(&ignored);
    sigaddset(&ignored, SIGPIPE);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setsigdefault(&attributes_, &ignored);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  }
  UsualSignals(const UsualSignals&) = delete;
  UsualSignals& operator=(const UsualSignals&) = delete;
  ~UsualSignals() { posix_spawnattr_destroy(&attributes_); }
  [[nodiscard]] const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

/// Starts a program in a folder, without input, its messages in a file.
/// @throws InputError where it cannot be started
pid_t start(std::vector<std::string> words, const fs::path& folder, std::FILE* messages) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(messages), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(messages), STDERR_FILENO);
  const UsualSignals signals;
  pid_t process = -1;
  int failure = 0;
  changeUnfinished([&](Unfinished& unfinished) {
    failure = posix_spawnp(&process, arguments.front(), &actions, signals.get(), arguments.data(),
                           environ);
    if (failure == 0) unfinished.helpers.insert(process);
  });
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw InputError(fmt::format("{}: {}", words.front(), std::strerror(failure)));
  return process;
}

/// @return as waitpid tells it; nothing while the process runs
std::optional<int> endOf(pid_t process, int options) {
  int state = 0;
  pid_t ended = 0;
  // Together, so that its number is never another process's while it is in the list.
  changeUnfinished([&](Unfinished& unfinished) {
    ended = ::waitpid(process, &state, options);
    if (ended != 0) unfinished.helpers.erase(process);
  });
  return ended == 0 ? std::nullopt : std::optional(state);
}

std::string contentOf(std::FILE* file) {
  std::rewind(file);
  std::array<char, 4096> buffer{};
  std::size_t size = std::fread(buffer.data(), 1, buffer.size(), file);
  while (size > 0 && buffer.at(size - 1) == '\n') --size;
  return {buffer.data(), size};
}

}  // namespace

bool hasFfmpeg() {
  const char* path = std::getenv("PATH");
  std::string_view folders = path != nullptr ? path : "";
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const fs::path program = fs::path(folders.substr(0, end)) / "ffmpeg";
    std::error_code ignored;
    if (fs::is_regular_file(program, ignored) && ::access(program.c_str(), X_OK) == 0) return true;
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return false;
}

Film::Film(fs::path folder, const std::string& pictures, std::string name)
    : folder_(std::move(folder)),
      name_(std::move(name)),
      file_(std::make_unique<PartFile>(folder_, ".webm")),
      messages_(std::tmpfile()) {
  if (!messages_) throw InputError(fmt::format("no temporary file: {}", std::strerror(errno)));
  process_ = start({"ffmpeg",
                    "-nostdin",
                    "-loglevel",
                    "error",
                    "-y",
                    "-framerate",
                    std::to_string(pathFramesPerSecond),
                    "-i",
                    pictures,
                    "-c:v",
                    "libvpx-vp9",
                    "-crf",
                    "24",
                    "-b:v",
                    "0",
                    "-pix_fmt",
                    "yuv420p",
                    "-f",
                    "webm",
                    "file:" + file_->path().filename().string()},
                   folder_, messages_.get());
}

Film::~Film() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  (void)endOf(process_, 0);
}

Film::Outcome Film::finish(int state) {
  if (!WIFEXITED(state) || WEXITSTATUS(state) != 0) {
    const std::string said = oneLine(contentOf(messages_.get()));
    return {false, said.empty() ? "it ended without a word" : said};
  }
  try {
    if (fs::file_size(file_->path()) == 0) return {false, "it wrote nothing"};
    syncFile(file_->descriptor(), folder_ / name_);
    file_->nameIt(folder_ / name_);
  } catch (const std::exception& error) {
    return {false, error.what()};
  }
  return {true, {}};
}

std::optional<Film::Outcome> Film::poll() {
  if (process_ <= 0) return std::nullopt;
  const auto state = endOf(process_, WNOHANG);
  if (!state) return std::nullopt;
  process_ = -1;
  Outcome outcome = finish(*state);
  file_.reset();
  return outcome;
}

}  // namespace gnomon::app
