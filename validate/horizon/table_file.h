#pragma once

#include <filesystem>

#include "horizon/stored_table.h"
#include "horizon/table_shape.h"

namespace gnomon::horizon {

/// The two horizon tables as they are stored, with what is needed to use them.
struct StoredHorizons : TableShape {
  double radiusTexels = 0;
  StoredTable horizon;   ///< δ, height units per texel; one layer an azimuth
  StoredTable distance;  ///< d, texels

  /// Bytes of both tables together, as a GPU would hold them.
  [[nodiscard]] std::size_t byteCount() const {
    return horizon.bytes.size() + distance.bytes.size();
  }
};

/// Writes both tables into one EXR: channels `horizon.000`… and `distance.000`…, one an azimuth,
/// with the stored codes themselves (half holds 8-bit codes exactly, uint 16-bit ones) or floats,
/// and attributes `gnomon:azimuths`, `gnomon:radiusTexels` (as text, which keeps every digit),
/// `gnomon:wrap` (repeat or clamp), `gnomon:bits`, `gnomon:horizonLow`, `gnomon:horizonHigh`,
/// `gnomon:distanceLow` and `gnomon:distanceHigh`. The image's first row is v = 1, as in a height
/// image. The file is written whole or not at all.
/// @throws InputError naming the file: a name without .exr, tables of unlike sizes or over 1000
///   azimuths; one that cannot be written
void writeHorizons(const std::filesystem::path& path, const StoredHorizons& horizons);

}  // namespace gnomon::horizon
