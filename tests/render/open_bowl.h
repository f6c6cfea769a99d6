#pragma once

#include <array>
#include <cstddef>

#include "surface/cage/shapes.h"

namespace gnomon::test {

/// z = (x² + y²) / 200 over |x|, |y| ≤ 32: a bowl that ends at its border.
inline surface::Cage openBowl() {
  std::array<Vec3, 16> points{};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const double ends = 32.0 * 32.0;
      const auto square = [&](int k) { return k == 0 || k == 3 ? ends : -ends / 3; };
      points[static_cast<std::size_t>(4 * j + i)] =
          Vec3(32.0 * (Vec2(i, j) / 1.5 - 1.0), (square(i) + square(j)) / 200);
    }
  }
  return surface::makeBezier(points, 16, 16);
}

}  // namespace gnomon::test
