#include <algorithm>
#include <cmath>

#include "common/disc_share.h"
#include "render/check/pass_faults.h"
#include "render/check/tally.h"
#include "render/check/tile_scene.h"

namespace gnomon::render::check {

std::string sharesFault(const Shaders& shaders) {
  constexpr double radius = radians(10.0);
  Method method =
      methodOf(DrawnMesh::base,
               "float visibility(Pixel pixel, LocalLight light) {\n"
               "  return float((int(pixel.texel.x) + 3 * int(pixel.texel.y)) % 17) / 16.0;\n"
               "}\n");
  method.hasTest = false;
  method.answersShares = true;
  const TileValues tiles;
  const VisibilityAnswers answers = tileShares(shaders, method, tiles, radius);
  Tally tally;
  for (int row = 0; row < tile::side; ++row) {
    for (int x = 0; x < tile::columns; ++x) {
      const int y = tile::side - 1 - row;
      const auto i = static_cast<std::size_t>(row * tile::columns + x);
      const double share = (x + 3 * y) % 17 / 16.0;
      const double sine = glm::dot(glm::normalize(tiles.normal(x, y)), tileLight());
      const double drawn = std::min(share, discShare(std::asin(sine) / radius));
      tally.add(answers.test.shares.at(i) == static_cast<float>(share) &&
                std::abs(static_cast<double>(answers.drawn.shares.at(i)) - drawn) < 1e-3);
    }
  }
  return tally.fault();
}

}  // namespace gnomon::render::check
