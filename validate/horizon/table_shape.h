#pragma once

#include <cstddef>

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

}  // namespace gnomon::horizon
