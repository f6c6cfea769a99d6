#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "common/files/part_file.h"

namespace gnomon::app {

/// Whether the program `ffmpeg` is on the PATH: the viewer makes films where it is, and needs it
/// for nothing else.
bool hasFfmpeg();

/// A film of numbered pictures, made by `ffmpeg` while the window goes on: WebM with VP9. The file
/// is there whole, or not at all.
class Film {
 public:
  /// Begins to make it.
  /// @param folder    of the pictures and of the film
  /// @param pictures  their names as printf has them, "frame-%04d.png", from 1
  /// @param name      of the film
  Film(std::filesystem::path folder, const std::string& pictures, std::string name);
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;
  /// Ends `ffmpeg` where it still works: there is no film then.
  ~Film();

  struct Outcome {
    bool isThere = false;
    std::string error;  ///< why it is not
  };
  /// What came of it; nothing while `ffmpeg` works. Once.
  std::optional<Outcome> poll();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  Outcome finish(int state);

  std::filesystem::path folder_;
  std::string name_;
  std::unique_ptr<PartFile> file_;
  std::unique_ptr<std::FILE, Closer> messages_;
  pid_t process_ = -1;
};

}  // namespace gnomon::app
