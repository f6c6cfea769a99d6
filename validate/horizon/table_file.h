#pragma once

#include <cstddef>
#include <filesystem>

#include "horizon/stored_table.h"
#include "relief/height_field.h"

namespace gnomon::horizon {

/// The size of a table over a height map, and how it goes on outside. Entries lie [layer][y][x],
/// x fastest; row y = 0 is at v = 0. A table of horizons has one layer an azimuth φ_m = 2πm/M.
struct TableShape {
  int width = 0;   ///< texels
  int height = 0;  ///< texels
  int layers = 0;
  relief::Wrap wrap = relief::Wrap::repeat;
  relief::Border border =
      {};  ///< past it, that is within half a texel of it, the outermost entries hold

  /// One entry a texel and layer.
  static TableShape over(const relief::HeightField& field, int layers) {
    return {field.width(), field.height(), layers, field.wrap(), field.border()};
  }

  [[nodiscard]] std::size_t texels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  [[nodiscard]] std::size_t entries() const { return entry(layers, 0, 0); }
  /// Where an entry lies.
  [[nodiscard]] std::size_t entry(int layer, int x, int y) const {
    return static_cast<std::size_t>(layer) * texels() +
           static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

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
