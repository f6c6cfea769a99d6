#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "relief/height_field.h"

namespace gnomon::horizon {

/// Bits that one table entry takes on the GPU.
enum class TableBits : int { eight = 8, sixteen = 16, thirtyTwo = 32 };

/// One table as a texture stores it: for 8 and 16 bits unsigned codes q with
/// value = low + q / (2^bits - 1) · (high - low); for 32 bits the floats themselves. The paper's
/// memory figures imply 8 bits (128² × 32 × 2 tables = 1.0 MB; Onoue, Max & Nishita 2004, §4).
struct StoredTable {
  TableBits bits = TableBits::eight;
  float low = 0;
  float high = 0;
  std::vector<std::uint8_t> bytes;  ///< codes (native endian) or floats, bits / 8 bytes an entry

  [[nodiscard]] std::size_t entryCount() const {
    return bytes.size() * 8 / static_cast<std::size_t>(bits);
  }
  [[nodiscard]] float value(std::size_t entry) const;
  /// Stores values, each from `low` to `high`, from an entry on.
  void set(std::size_t entry, std::span<const float> values);
};

/// Stores values with `low` and `high` their extremes, so that both are exact; rounds to nearest:
/// no entry is off by more than half a step, (high - low) / (2^bits - 1) / 2. Distances are never
/// negative, so a distance of 0 (attached shadow) is stored exactly. No values: low = high = 0.
/// @throws InputError if a value is not finite, naming its index
StoredTable storeTable(std::span<const float> values, TableBits bits);

/// A table of so many entries, all bytes 0, for values from `low` to `high`.
StoredTable emptyTable(std::size_t entries, TableBits bits, float low, float high);

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
void writeHorizons(const std::filesystem::path& file, const StoredHorizons& horizons);

}  // namespace gnomon::horizon
