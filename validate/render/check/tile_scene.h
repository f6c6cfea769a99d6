#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "render/passes/method_pass.h"

// Two faces side by side with maps of random zeros and ones, of which one sample a texel is drawn.

namespace gnomon::render::check {

namespace tile {
constexpr int side = 8;            ///< samples, and texels, of a face's side
constexpr int columns = 2 * side;  ///< of the whole view, and of the maps
constexpr int azimuths = 4;        ///< of the horizon and distance tables
}  // namespace tile

/// What the maps hold at texel (x, y).
struct TileValues {
  TileValues();

  std::vector<float> heights, horizon, distance, ellipse, angles;

  [[nodiscard]] static bool bit(const std::vector<float>& bits, int layer, int x, int y) {
    return bits.at(static_cast<std::size_t>((layer * tile::side + y) * tile::columns + x)) > 0.5F;
  }
  [[nodiscard]] double height(int x, int y) const {
    return bit(heights, 0, x % tile::columns, y % tile::side) ? 1 : 0;
  }
  /// N', without its length, a quarter of a texel beyond the texel's centre.
  [[nodiscard]] Vec3 normal(int x, int y) const;
};

/// The two faces. Samples lie a quarter of a texel beyond texel centres: of the four texels that
/// are mixed, that one has more than half of the weight.
surface::BaseMesh tileMesh();

/// One sample a texel.
RenderView tileView();

/// The unit vector toward the light.
Vec3 tileLight();

/// Draws the faces by a method under a light that is a disc, with tables in 32 bits.
/// @param radius  of the disc, radians
VisibilityAnswers tileShares(const std::filesystem::path& shaders, const Method& method,
                             const TileValues& tiles, double radius);

/// Draws the faces by a method, with tables in 8, 16 and 32 bits, and compares both of its answers.
/// @param isDark  what the method's test must say at texel (x, y)
/// @returns as passFault
std::string tileFault(const std::filesystem::path& shaders, const Method& method,
                      TableFilter filter,
                      const std::function<bool(const TileValues&, int x, int y)>& isDark);

}  // namespace gnomon::render::check
