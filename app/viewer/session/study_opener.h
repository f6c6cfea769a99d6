#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "viewer/session/opened_study.h"

namespace gnomon::app {

/// The studies to choose from beside an open one: those of the command line, then the other TOML
/// files of the open one's folder by name; each once.
std::vector<std::filesystem::path> studiesBeside(const cli::ViewRequest& request);

/// Reads another study while the window goes on with the one before.
class StudyOpener {
 public:
  /// A study that was read, or why it was not.
  struct Answer {
    std::optional<OpenedStudy> study;
    std::string error;
  };

  /// @param wake  called from another thread once there is an answer
  explicit StudyOpener(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Begins to read a study with the options of a request; what it asks to show does not count.
  /// While another one is being read, nothing.
  void open(const std::filesystem::path& study, cli::ViewRequest request);
  /// Once for each study.
  std::optional<Answer> take();
  /// The file's name while it is read; empty otherwise.
  [[nodiscard]] const std::string& opening() const { return opening_; }

 private:
  std::function<void()> wake_;
  std::string opening_;
  std::future<Answer> answer_;  ///< its thread ends before this object does
};

}  // namespace gnomon::app
