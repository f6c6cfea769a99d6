#pragma once

#include <filesystem>

namespace gnomon {

/// Where this very code lies. It may be part of a program or of the shared library that other
/// programs link.

/// The file that holds this code: "/proc/self/exe" in a program, which can be read even after
/// another file has taken its place, or the path of the shared library.
std::filesystem::path ownFile();

/// The folder PREFIX of an installed PREFIX/bin/PROGRAM or PREFIX/lib/LIBRARY. Where this code is
/// not installed, no folder `share` or `lib` of Gnomon is in it.
std::filesystem::path installPrefix();

/// The program that answers for this code in a process of its own: the program itself, or the
/// program `gnomon` that was built or installed with the shared library.
std::filesystem::path ownProgram();

}  // namespace gnomon
