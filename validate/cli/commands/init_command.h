#pragma once

#include <filesystem>

#include "common/error.h"

namespace gnomon::cli {

/// Writes a starter into a folder, which is made if it is missing: a study, a method and a workflow
/// of a build server, copies of scenes/starter; and prints what to do next. No file is written
/// where one of them is there already.
/// @throws InputError naming the file that is there, or that cannot be written
ExitStatus writeStarter(const std::filesystem::path& folder);

}  // namespace gnomon::cli
