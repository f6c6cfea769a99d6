#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

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

/// When a file's bytes must have reached the disk. `now`: before it takes its name, so that after a
/// power cut the name stands for the old file or the whole new one. `later`: where the caller sees
/// to it before it relies on the file, or can tell a damaged one: a wait for the disk may take 10
/// ms.
enum class Sync { now, later };

/// Writes a file whole or not at all: `write` fills a temporary file beside `path`, which then
/// takes the name. If `write` throws, the temporary file is removed and `path` is as it was.
/// `write` gets the open file's descriptor and not its name: whoever opens the name creates the
/// file anew where a signal has just removed it. The descriptor stays the caller's to close.
/// Links are followed. What is there and is no file (a device, a pipe, an open stream as
/// /dev/stdout) is never replaced: it is written directly.
/// @throws InputError naming the file and the system's reason when it cannot be written
void writeAtomically(const std::filesystem::path& path, const std::function<void(int file)>& write,
                     Sync sync = Sync::now);

/// Writes bytes to an open file.
/// @throws std::filesystem::filesystem_error, which writeAtomically turns into an InputError
void writeAll(int file, std::string_view bytes);

/// As writeAtomically, with the content at hand. Removes what killed writers left in the file's
/// folder.
void writeTextAtomically(const std::filesystem::path& path, std::string_view text);

/// Replaces `path`, which lies in a folder that is the program's own. Links are not followed, and
/// leftovers are somebody else's care: see removeLeftovers.
/// @param workplace  the folder of the temporary file, in the same file system
void replaceFile(const std::filesystem::path& path, std::string_view text, Sync sync,
                 const std::filesystem::path& workplace);

/// The whole content of a file, bytes as they are.
/// @throws InputError as requireFile and readBytes; MemoryError for one that does not fit
std::string readFile(const std::filesystem::path& path);

/// Wait until bytes and names that were written are on the disk, so that a power cut does not take
/// them. What lies on no disk (a pipe, a file system in memory) has nothing to wait for.
/// @throws std::filesystem::filesystem_error where they did not get there

/// The bytes of an open file.
/// @param path  for the message
void syncFile(int descriptor, const std::filesystem::path& path);
/// The names in a folder.
void syncFolder(const std::filesystem::path& folder);
/// All that any process wrote to the file system of a folder: for many files one wait, where one
/// each would take some 10 ms a file.
void syncFileSystem(const std::filesystem::path& folder);

}  // namespace gnomon
