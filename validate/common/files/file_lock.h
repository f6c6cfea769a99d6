#pragma once

#include <filesystem>

namespace gnomon {

/// An exclusive lock on a file, which is created where it is not there. The kernel releases it when
/// the object or its process goes, however that comes about; it keeps out the processes of other
/// containers, and of other machines where the file system's locks reach them.
class FileLock {
 public:
  enum class Wait { yes, no };
  /// `noFile`: it cannot be opened. `noLocks`: its file system has none.
  enum class State { held, elsewhere, noFile, noLocks };

  FileLock(const std::filesystem::path& file, Wait wait);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

  [[nodiscard]] State state() const { return state_; }

 private:
  int file_;
  State state_ = State::noFile;
};

}  // namespace gnomon
