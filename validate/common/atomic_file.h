#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace gnomon {

/// Writes a file whole or not at all: `write` fills a temporary file beside `path`, which then
/// takes the name. If `write` throws, the temporary file is removed and `path` is as it was.
/// The temporary name keeps the extension, since image writers choose their format by it.
/// @throws InputError when the file cannot be created or renamed
void writeAtomically(const std::filesystem::path& path,
                     const std::function<void(const std::filesystem::path&)>& write);

/// As above, with the content at hand.
void writeTextAtomically(const std::filesystem::path& path, std::string_view text);

/// The whole content of a file, bytes as they are.
/// @throws InputError naming the file when it cannot be read or is no file; MemoryError for one
/// that
///   does not fit
std::string readFile(const std::filesystem::path& path);

}  // namespace gnomon
