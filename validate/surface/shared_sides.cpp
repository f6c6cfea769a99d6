#include "surface/shared_sides.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace gnomon::surface {
namespace {

/// A side with its two cage vertices, the lower first.
struct VertexSide {
  int low, high;
  FaceSide of;

  [[nodiscard]] auto order() const { return std::tie(low, high, of.face, of.side); }
};

}  // namespace

std::vector<SharedSide> sharedSides(const LimitSurface& surface) {
  std::vector<VertexSide> sides;
  sides.reserve(4 * static_cast<std::size_t>(surface.faceCount()));
  for (int face = 0; face < surface.faceCount(); ++face) {
    const std::array<int, 4> corners = surface.corners(face);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [low, high] = std::minmax(corners.at(k), corners.at((k + 1) % 4));
      sides.push_back({low, high, {face, static_cast<int>(k)}});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const VertexSide& a, const VertexSide& b) { return a.order() < b.order(); });
  std::vector<SharedSide> shared;
  // A LimitSurface has at most two faces at an edge.
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const VertexSide& a = sides[i - 1];
    const VertexSide& b = sides[i];
    if (a.low == b.low && a.high == b.high) shared.push_back({a.of, b.of});
  }
  return shared;
}

}  // namespace gnomon::surface
