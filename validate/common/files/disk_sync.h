#pragma once

#include <filesystem>

namespace gnomon {

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
