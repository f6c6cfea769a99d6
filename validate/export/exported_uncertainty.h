#pragma once

#include <filesystem>
#include <optional>

namespace gnomon::exporting {

/// The uncertainty of a truth's mask or shares that lie in an export, a share of its samples: what
/// the `export.json` one or two folders up states.
/// @return none for any other file
/// @throws InputError for an `export.json` that is damaged
std::optional<double> exportedUncertainty(const std::filesystem::path& truthMask);

}  // namespace gnomon::exporting
