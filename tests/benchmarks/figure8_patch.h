#pragma once

#include <array>

#include "relief/patterns.h"
#include "relief/relief.h"
#include "surface/cage/shapes.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"

namespace gnomon::benchmarks {

/// The surface and the relief of scenes/figure8.toml.
struct Figure8Patch {
  surface::LimitSurface surface{surface::makeBezier(points(), columns, rows)};
  relief::Relief relief{relief::makeColumns(192, 160, {32, 7, 3}, 8, relief::Wrap::clamp),
                        relief::HeightSpace::texture, Vec2(1)};
  static constexpr int columns = 24;
  static constexpr int rows = 20;

  /// A picture of the whole patch, `side` × `side` samples a face: neighbours on the surface are
  /// neighbours in it, as in a camera's view.
  [[nodiscard]] static surface::SampleGrid samples(int side) {
    surface::SampleGrid grid{columns * side, rows * side, {}};
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        const auto place = [side](int k) {
          return (static_cast<float>(k % side) + 0.5F) / static_cast<float>(side);
        };
        grid.samples.push_back({y / side * columns + x / side, place(x), place(y)});
      }
    }
    return grid;
  }

 private:
  static std::array<Vec3, 16> points() {
    std::array<Vec3, 16> points{};
    constexpr std::array across = {-66.0, -50.0, 50.0, 66.0};
    constexpr std::array along = {-80.0, -28.0, 28.0, 80.0};
    for (std::size_t k = 0; k < points.size(); ++k) {
      const bool middleColumn = k % 4 == 1 || k % 4 == 2;
      const bool middleRow = k / 4 == 1 || k / 4 == 2;
      points[k] = {across[k % 4], along[k / 4], (middleColumn ? 34 : -48) + (middleRow ? 24 : 0)};
    }
    return points;
  }
};

}  // namespace gnomon::benchmarks
