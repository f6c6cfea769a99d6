#include "horizon/angle_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

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

AngleTable horizonAngles(const HorizonTables& tables, double limit, double texelsPerHeight) {
  AngleTable result{static_cast<const TableShape&>(tables), limit,
                    std::vector<float>(tables.horizon.size())};
  constexpr std::size_t anglesAtOnce = 1 << 12;
  parallelFor(
      0, result.angles.size(),
      [&](std::size_t i) {
        const double angle = std::atan2(1.0, texelsPerHeight * tables.horizon[i]);
        result.angles[i] = static_cast<float>(std::min(angle, limit));
      },
      anglesAtOnce);
  return result;
}

namespace {

/// Area, first and second moments of a region of the plane.
struct Moments {
  double area = 0;
  Vec2 first{0, 0};
  double xx = 0, xy = 0, yy = 0;
};

/// Adds a wedge from the origin of angular width `width` about direction e, `radius` long: as the
/// integral of ρ dρ over a thin sector.
void addSector(Moments& moments, Vec2 e, double width, double radius) {
  const double square = radius * radius;
  moments.area += width * square / 2;
  moments.first += width * square * radius / 3 * e;
  const double second = width * square * square / 4;
  moments.xx += second * e.x * e.x;
  moments.xy += second * e.x * e.y;
  moments.yy += second * e.y * e.y;
}

/// c_x, c_y, A_xx, A_xy, A_yy.
std::array<double, EllipseTable::numbers> ellipseOf(const Moments& m) {
  if (!(m.area > 0)) return {};
  const Vec2 c = m.first / m.area;
  const double xx = std::max(m.xx / m.area - c.x * c.x, 0.0);
  const double xy = m.xy / m.area - c.x * c.y;
  const double yy = std::max(m.yy / m.area - c.y * c.y, 0.0);
  // The square root of a symmetric 2 × 2 matrix Σ: (Σ + √det Σ · I) / √(tr Σ + 2 √det Σ).
  const double root = std::sqrt(std::max(xx * yy - xy * xy, 0.0));
  const double scale = std::sqrt(xx + yy + 2 * root);
  if (!(scale > 0)) return {c.x, c.y, 0, 0, 0};
  return {c.x, c.y, 2 * (xx + root) / scale, 2 * xy / scale, 2 * (yy + root) / scale};
}

}  // namespace

EllipseTable fitEllipses(const HorizonTables& tables, double texelsPerHeight) {
  EllipseTable result{tables, {}};
  result.layers = EllipseTable::numbers;
  result.values.resize(result.entries());
  const auto width = static_cast<std::size_t>(tables.width);
  const std::size_t texels = tables.texels();
  const double sector = 2 * pi / tables.layers;
  parallelFor(0, static_cast<std::size_t>(tables.height), [&](std::size_t row) {
    for (std::size_t texel = row * width; texel < (row + 1) * width; ++texel) {
      Moments moments;
      for (int m = 0; m < tables.layers; ++m) {
        const double slope = tables.horizon[static_cast<std::size_t>(m) * texels + texel];
        const double azimuth = sector * m;
        addSector(moments, {std::cos(azimuth), std::sin(azimuth)}, sector,
                  1 / std::hypot(1.0, std::max(texelsPerHeight * slope, 0.0)));
      }
      const auto ellipse = ellipseOf(moments);
      for (std::size_t layer = 0; layer < ellipse.size(); ++layer) {
        result.values[layer * texels + texel] =
            static_cast<float>(std::clamp(ellipse.at(layer), -1.0, 1.0));
      }
    }
  });
  return result;
}

}  // namespace gnomon::horizon
