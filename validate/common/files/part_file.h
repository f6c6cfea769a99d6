#pragma once

#include <filesystem>
#include <string>

namespace gnomon {

/// A file that is being written and has no name of its own yet. It is called
/// `.gnomon-MACHINE-PROCESS-RANDOM.part.EXT`: MACHINE (8 hexadecimal digits) tells one running
/// kernel from all others, PROCESS is a process id, which is no other's on that machine but may be
/// in another container, RANDOM (16 digits) parts those. While this object lives it holds a lock on
/// the file, which the kernel releases when the process dies: that is how a leftover is told from a
/// file that a living process writes, wherever that process runs.
class PartFile {
 public:
  /// Creates the file, empty.
  /// @param extension  with its dot, or empty
  /// @throws std::filesystem::filesystem_error
  PartFile(const std::filesystem::path& folder, const std::string& extension);
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  /// Removes the file, unless it has got a name.
  ~PartFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Open for writing, at the file's begin.
  [[nodiscard]] int descriptor() const { return file_; }

  /// Gives it a name in the same file system; what had that name is gone.
  /// @throws std::filesystem::filesystem_error
  void nameIt(const std::filesystem::path& name);

 private:
  std::filesystem::path path_;  ///< empty: it has a name
  int file_ = -1;
};

/// A folder that is being filled and has no name of its own yet: likewise `.gnomon-….part`, locked
/// while this object lives.
class PartFolder {
 public:
  /// Creates the folder beside another one, and that one's parents; removes what dead writers left
  /// there.
  /// @throws InputError where it cannot be created
  explicit PartFolder(const std::filesystem::path& beside);
  PartFolder(const PartFolder&) = delete;
  PartFolder& operator=(const PartFolder&) = delete;
  /// Removes the folder with all that is in it, unless it has got a name.
  ~PartFolder();

  /// Empty when it has a name.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Gives it a name in the same file system; a folder that had that name goes with all that is in
  /// it.
  /// @throws std::filesystem::filesystem_error
  void nameIt(const std::filesystem::path& name);

 private:
  std::filesystem::path path_;
  int folder_ = -1;
};

/// Removes the part files and folders in a folder whose writers are dead. Those of another machine,
/// whose locks may not show here, are left for an hour after their last write. Never fails.
void removeLeftovers(const std::filesystem::path& folder);

}  // namespace gnomon
