#include "viewer/window/film.h"

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/files/disk_sync.h"
#include "common/system/child_process.h"
#include "common/text/one_line.h"
#include "model/light_path.h"

namespace gnomon::app {
namespace fs = std::filesystem;
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
  const std::vector<std::string> words = {"ffmpeg",
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
                                          "file:" + file_->path().filename().string()};
  const ChildStart started =
      startChild({words, {}, folder_, nullptr, messages_.get(), messages_.get()});
  if (started.failure != 0) {
    throw InputError(fmt::format("ffmpeg: {}", std::strerror(started.failure)));
  }
  process_ = started.process;
}

Film::~Film() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  (void)endOfChild(process_, true);
}

Film::Outcome Film::finish(int state) {
  if (!WIFEXITED(state) || WEXITSTATUS(state) != 0) {
    std::string said = contentOf(messages_.get());
    while (said.ends_with('\n')) said.pop_back();
    return {false, said.empty() ? "it ended without a word" : oneLine(said)};
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
  const auto state = endOfChild(process_, false);
  if (!state) return std::nullopt;
  process_ = -1;
  Outcome outcome = finish(*state);
  file_.reset();
  return outcome;
}

}  // namespace gnomon::app
