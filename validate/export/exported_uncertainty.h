#pragma once

#include <array>
#include <filesystem>
#include <optional>

namespace gnomon::exporting {

/// Where the `export.json` of a mask's export would be: one and two folders up.
std::array<std::filesystem::path, 2> exportIndices(const std::filesystem::path& truthMask);

/// The uncertainty of a truth's mask or shares that lie in an export, a share of its samples: what
/// its `export.json` states.
/// @return none for any other file
/// @throws InputError for an `export.json` that is damaged
std::optional<double> exportedUncertainty(const std::filesystem::path& truthMask);

}  // namespace gnomon::exporting
