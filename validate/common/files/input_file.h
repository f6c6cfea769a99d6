#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon {

/// Refuses, before anything is opened, what is no file with bytes of its own: to open a FIFO waits
/// for somebody to write into it, and a device may never end.
/// @throws InputError "PATH: no such file", "PATH: is a FIFO, a file was expected" (a folder, a
///   device, a socket), or "PATH: cannot be read: Permission denied", as the system puts it
void requireFile(const std::filesystem::path& file);

/// Whether there is something of this name.
/// @throws InputError where the system does not tell, as for a folder without permission or a name
///   that is too long: "PATH: cannot be read: File name too long"
bool isThere(const std::filesystem::path& file);

/// All bytes of what has a name, to its end.
/// @throws InputError "PATH: cannot be read: Input/output error", as the system puts it;
///   MemoryError for more bytes than fit
std::string readBytes(const std::filesystem::path& file);

/// Whether a name stands for something that the process was started with: /dev/stdin, /dev/fd/N or
/// /proc/self/fd/N.
bool isGivenStream(const std::filesystem::path& file);

/// A file's bytes, or those of a pipe that the process was started with, which can be read once
/// alone: `… | gnomon run /dev/stdin`, `gnomon run <(…)`.
/// @throws InputError as requireFile and readBytes, and for a pipe of more than 64 MiB
std::string readFileOrStream(const std::filesystem::path& file);

/// The SHA-256 of bytes (FIPS 180-4) as 64 lowercase hexadecimal digits: what `sha256sum` prints.
/// @throws InternalError where the library refuses
std::string sha256(std::string_view bytes);

/// Bytes in Base64 (RFC 4648, section 4), padded, in one line.
std::string base64(std::string_view bytes);

}  // namespace gnomon
