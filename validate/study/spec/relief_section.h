#pragma once

#include <filesystem>

#include "relief/relief.h"
#include "study/spec/toml_reader.h"

namespace gnomon {

/// The relief that `[relief]` asks for: an `image` or a `pattern`.
/// @param folder  of the study: what paths are relative to
Relief readReliefSection(const TomlReader& section, const std::filesystem::path& folder);

}  // namespace gnomon
