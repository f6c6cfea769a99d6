#include "horizon/angle_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "common/parallel.h"
#include "common/vec.h"

namespace gnomon::horizon {

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
