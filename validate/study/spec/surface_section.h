#pragma once

#include <filesystem>

#include "study/spec/toml_reader.h"
#include "surface/cage.h"

namespace gnomon {

/// The cage that `[surface]` asks for: a built-in `shape` or a `mesh` file.
/// @param folder  of the study: what paths are relative to
Cage readSurfaceSection(const TomlReader& section, const std::filesystem::path& folder);

}  // namespace gnomon
