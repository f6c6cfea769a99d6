#pragma once

#include <filesystem>
#include <optional>

namespace gnomon {

/// Where this very code lies. It may be part of a program or of the shared library that other
/// programs link.

/// The file that holds this code: "/proc/self/exe" in a program, which can be read even after
/// another file has taken its place, or the path of the shared library.
std::filesystem::path ownFile();

/// The folder that this code lies in.
std::filesystem::path ownFolder();

/// What is installed or built with this code: RELATIVE in the nearest of the code's own folder and
/// those above it that holds it, links resolved. So PREFIX/bin/PROGRAM and PREFIX/lib/LIBRARY find
/// PREFIX/share/…, wherever PREFIX is moved, and programs of a build find the build's own share/….
/// None where no folder holds it.
std::optional<std::filesystem::path> installedFile(const std::filesystem::path& relative);

/// The program that answers for this code in a process of its own: the program itself, or the
/// program `gnomon` that was built or installed with the shared library.
std::filesystem::path ownProgram();

}  // namespace gnomon
