#include "horizon/texel_scale.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "common/error.h"
#include "common/parallel.h"
#include "surface/texel_frame.h"

namespace gnomon::horizon {
namespace {

struct FaceScale {
  double world = 0;   ///< area
  double texels = 0;  ///< area
  double farthest = 0;
};

FaceScale faceScale(const surface::LimitSurface& surface, int face, int side, Vec2 texelsPerUv) {
  FaceScale scale;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const surface::TangentPoint point =
          surface.tangentPoint(face, (i + 0.5) / side, (j + 0.5) / side);
      const Vec3 place = glm::abs(point.position);
      scale.farthest = std::max({scale.farthest, place.x, place.y, place.z});
      if (!surface::texelFrame(point, texelsPerUv).defined) continue;
      const Vec2 s = texelsPerUv * point.uvDs;
      const Vec2 t = texelsPerUv * point.uvDt;
      scale.world += glm::length(glm::cross(point.ds, point.dt)) / (side * side);
      scale.texels += std::abs(s.x * t.y - s.y * t.x) / (side * side);
    }
  }
  return scale;
}

void requireFloatsHold(const TexelScale& scale) {
  constexpr double narrowest = 1e-7;
  constexpr double widest = 1e7;
  if (scale.width == 0) return;
  if (!(scale.width >= narrowest && scale.width <= widest)) {
    throw InputError(fmt::format(
        "surface: a texel is {:.3g} world units wide on average, {:g} to {:g} expected: "
        "scale the mesh or its texture coordinates",
        scale.width, narrowest, widest));
  }
  const double apart = scale.farthest * std::numeric_limits<float>::epsilon();
  if (!(64 * apart <= scale.width)) {
    throw InputError(fmt::format(
        "surface: it reaches {:.6g} world units from the origin, where floats are {:.3g} "
        "apart and a texel is {:.3g} wide, at most 1/64 of that expected: move the mesh "
        "nearer to the origin",
        scale.farthest, apart, scale.width));
  }
}

}  // namespace

TexelScale texelScale(const surface::LimitSurface& surface, Vec2 texelsPerUv) {
  constexpr double points = 16384;
  const auto faces = static_cast<std::size_t>(surface.faceCount());
  const int side = std::max(1, static_cast<int>(std::sqrt(points / static_cast<double>(faces))));
  std::vector<FaceScale> scales(faces);
  parallelFor(
      0, faces,
      [&](std::size_t face) {
        scales[face] = faceScale(surface, static_cast<int>(face), side, texelsPerUv);
      },
      64);
  FaceScale whole;
  for (const FaceScale& face : scales) {
    whole.world += face.world;
    whole.texels += face.texels;
    whole.farthest = std::max(whole.farthest, face.farthest);
  }
  const double width = whole.texels > 0 ? std::sqrt(whole.world / whole.texels) : 0;
  requireFloatsHold({width, whole.farthest});
  return {width, whole.farthest};
}

double texelsPerHeight(relief::HeightSpace space, const TexelScale& scale) {
  return space == relief::HeightSpace::texture || scale.width == 0 ? 1 : 1 / scale.width;
}

}  // namespace gnomon::horizon
