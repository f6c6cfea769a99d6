#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "relief/relief.h"
#include "surface/cage/shapes.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"

namespace gnomon::test {

/// A relief that is `height` where `isHigh(i, j)` holds and 0 elsewhere.
template <typename IsHigh>
relief::Relief stepRelief(int width, int height, double amplitude, const IsHigh& isHigh,
                          relief::Wrap wrap = relief::Wrap::clamp) {
  std::vector<float> texels;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      texels.push_back(isHigh(i, j) ? static_cast<float>(amplitude) : 0.0F);
    }
  }
  return {relief::HeightField(width, height, std::move(texels), wrap), relief::HeightSpace::world,
          Vec2(1)};
}

inline relief::Relief flatRelief(int width, int height) {
  return stepRelief(width, height, 0, [](int, int) { return false; });
}

/// A plane of one world unit a texel for the wall.
inline surface::Cage wallPlane() {
  return surface::makePlane(96, 32, 12, 4);
}

/// A wall along y, 6 high: its top lies between x = 28.5 and 31.5, its sides fall to 27.5 and 32.5.
inline relief::Relief wallRelief() {
  return stepRelief(96, 32, 6, [](int i, int) { return i >= 28 && i < 32; });
}

/// Independent heights in [0, amplitude): the roughest relief there is.
inline relief::Relief randomRelief(int width, int height, double amplitude, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<float> texels(static_cast<std::size_t>(width * height));
  for (float& texel : texels) {
    texel = static_cast<float>(amplitude * static_cast<double>(random()) / 4294967296.0);
  }
  return {relief::HeightField(width, height, std::move(texels), relief::Wrap::repeat),
          relief::HeightSpace::world, Vec2(1)};
}

/// The unit vector toward a light; degrees.
inline Vec3 lightToward(double azimuth, double elevation) {
  const double a = radians(azimuth);
  const double e = radians(elevation);
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

/// The sample of a grid chart at texture position (x, y) in texels of a map of the given size.
inline surface::SurfaceSample sampleAt(const surface::LimitSurface& surface,
                                       const relief::Relief& relief, Vec2 texel) {
  const surface::GridChart grid = surface.grid().value();
  const Vec2 place = texel / relief.texelsPerUv() * Vec2(grid.columns, grid.rows);
  const Vec2 cell = glm::min(glm::floor(place), Vec2(grid.columns - 1, grid.rows - 1));
  return {static_cast<int>(cell.y) * grid.columns + static_cast<int>(cell.x),
          static_cast<float>(place.x - cell.x), static_cast<float>(place.y - cell.y)};
}

/// A row of samples at texture positions from `begin` to `end`.
inline surface::SampleGrid sampleLine(const surface::LimitSurface& surface,
                                      const relief::Relief& relief, Vec2 begin, Vec2 end,
                                      int count) {
  surface::SampleGrid grid{count, 1, {}};
  for (int k = 0; k < count; ++k) {
    const double share = (k + 0.5) / count;
    grid.samples.push_back(sampleAt(surface, relief, begin + share * (end - begin)));
  }
  return grid;
}

/// `side` × `side` samples of every face, one row of the grid a face.
inline surface::SampleGrid samplesOfAllFaces(const surface::LimitSurface& surface, int side) {
  surface::SampleGrid grid{side * side, surface.faceCount(), {}};
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (int k = 0; k < side * side; ++k) {
      grid.samples.push_back({face,
                              (static_cast<float>(k % side) + 0.5F) / static_cast<float>(side),
                              (static_cast<float>(k / side) + 0.5F) / static_cast<float>(side)});
    }
  }
  return grid;
}

/// A plane z = 0 whose texture coordinates are neither orthogonal nor of equal length: the point of
/// texel (x, y) is (x - width/2) px + (y - height/2) py. A mirrored map (px × py < 0) keeps the
/// outward normal at +z.
struct ShearedPlane {
  Vec2 px, py;  ///< world per texel
  int width = 96;
  int height = 32;
  int columns = 12;
  int rows = 4;

  [[nodiscard]] double determinant() const { return px.x * py.y - py.x * px.y; }
  [[nodiscard]] bool mirrored() const { return determinant() < 0; }
  /// World length of one height unit.
  [[nodiscard]] double worldPerHeight(relief::HeightSpace space) const {
    return space == relief::HeightSpace::world ? 1 : std::sqrt(std::abs(determinant()));
  }
  [[nodiscard]] surface::Cage cage() const {
    surface::Cage cage = surface::makePlane(width, height, columns, rows);
    for (Vec3& position : cage.positions) {
      const double x = mirrored() ? -position.x : position.x;
      position = Vec3(x * px + position.y * py, 0);
    }
    if (mirrored()) {
      for (Vec2& uv : cage.uvs) uv.x = 1 - uv.x;
      cage.grid.reset();
    }
    return cage;
  }
  /// The sample at a place of the map, texels.
  [[nodiscard]] surface::SurfaceSample sampleAt(Vec2 texel) const {
    const Vec2 uv = texel / Vec2(width, height);
    const Vec2 place = Vec2(mirrored() ? 1 - uv.x : uv.x, uv.y) * Vec2(columns, rows);
    const Vec2 cell = glm::min(glm::floor(place), Vec2(columns - 1, rows - 1));
    return {static_cast<int>(cell.y) * columns + static_cast<int>(cell.x),
            static_cast<float>(place.x - cell.x), static_cast<float>(place.y - cell.y)};
  }
  /// World length of one texel along a direction of the texture plane, radians.
  [[nodiscard]] double worldPerTexel(double azimuth) const {
    return glm::length(std::cos(azimuth) * px + std::sin(azimuth) * py);
  }
  /// The light over that direction at an elevation; radians.
  [[nodiscard]] Vec3 lightOver(double azimuth, double elevation) const {
    const Vec2 along = glm::normalize(std::cos(azimuth) * px + std::sin(azimuth) * py);
    return {std::cos(elevation) * along, std::sin(elevation)};
  }
};

/// The frames that a test of the metric goes through: stretched, sheared, both, and mirrored.
inline std::vector<ShearedPlane> shearedPlanes() {
  return {{{2, 0}, {0, 0.5}},
          {{0.4, 0}, {0, 1.5}},
          {{1, 0}, {0.8, 1.1}},
          {{1.6, -0.3}, {0.9, 0.7}},
          {{-1.2, 0.2}, {0.5, 0.9}}};
}

/// A cube's cage: a closed surface of six faces, each with the whole texture, so that every edge is
/// a seam whose two sides have different heights.
inline surface::Cage cubeCage() {
  surface::Cage cage;
  for (int k = 0; k < 8; ++k) {
    cage.positions.push_back(10.0 * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
  }
  cage.faceVertices = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  cage.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int face = 0; face < 6; ++face) {
    for (int corner = 0; corner < 4; ++corner) cage.faceUvs.push_back(corner);
  }
  return cage;
}

}  // namespace gnomon::test
