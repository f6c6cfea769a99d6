#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace gnomon {

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
