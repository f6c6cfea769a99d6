#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

}  // namespace gnomon::horizon
