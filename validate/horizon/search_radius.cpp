#include "horizon/search_radius.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/parallel.h"
#include "horizon/reference.h"
#include "surface/curvature.h"
#include "surface/texel_frame.h"

namespace gnomon::horizon {
namespace {

constexpr double mostTexels = 16384;

/// Where a ray leaves and where the ground comes back to it, world; infinite where it does neither.
struct Leave {
  double at, back;
};

Leave leaveOf(const RayWay& way) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const double kappa = way.curvature;
  const double rise = way.highest - way.lowest;
  // The circle is a line to all digits that count.
  if (std::abs(kappa) * std::max(rise, std::abs(way.highest)) < 1e-12) {
    return {way.slope > 0 ? rise / way.slope : never, never};
  }
  const double theta = std::atan(way.slope);
  const double top = 1 + kappa * way.highest;
  const double cosine = std::cos(theta) * (1 + kappa * way.lowest) / top;
  if (!(top > 0) || !(cosine <= 1)) return {never, never};
  const double angle = std::acos(std::max(cosine, -1.0));
  if (kappa > 0) return {(angle - theta) / kappa, never};
  return {(theta - angle) / -kappa, (theta + angle) / -kappa};
}

bool isDark(const RayWay& way) {
  if (way.curvature > 0) return way.slope <= bareHorizon(way.curvature, way.highest);
  return way.slope <= 0;
}

/// The points of the grid on one face.
class Face {
 public:
  Face(const surface::LimitSurface& surface, int face, int side)
      : surface_(surface), face_(face), side_(side) {}

  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (int j = 0; j < side_; ++j) {
      for (int i = 0; i < side_; ++i) {
        visit(surface_.evaluate(face_, (i + 0.5) / side_, (j + 0.5) / side_));
      }
    }
  }

 private:
  const surface::LimitSurface& surface_;
  int face_;
  int side_;
};

double diagonalOf(const std::vector<Vec3>& lows, const std::vector<Vec3>& highs) {
  Vec3 low = lows.front();
  Vec3 high = highs.front();
  for (const Vec3& corner : lows) low = glm::min(low, corner);
  for (const Vec3& corner : highs) high = glm::max(high, corner);
  return glm::length(high - low);
}

/// The surface's box holds its grid: too small by less than a grid's step.
double diagonal(const surface::LimitSurface& surface, int side) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const auto faces = static_cast<std::size_t>(surface.faceCount());
  std::vector<Vec3> lows(faces, Vec3(far));
  std::vector<Vec3> highs(faces, Vec3(-far));
  parallelFor(
      0, faces,
      [&](std::size_t face) {
        Face(surface, static_cast<int>(face), side).forEach([&](const surface::LimitPoint& point) {
          lows[face] = glm::min(lows[face], point.position);
          highs[face] = glm::max(highs[face], point.position);
        });
      },
      64);
  return diagonalOf(lows, highs);
}

void take(SearchRadius& most, const SearchRadius& found) {
  if (found.bound == RadiusBound::unlit) return;
  if (most.bound == RadiusBound::unlit || found.texels > most.texels) most = found;
}

/// The ray from one point toward one light, in texels.
SearchRadius radiusAt(const surface::LimitPoint& point, const surface::TexelFrame& frame,
                      const relief::Relief& relief, const Vec3& light, double diagonal) {
  const surface::LocalLight local = surface::localLight(frame, light);
  if (std::isinf(local.slope)) {  // the light stands along the normal
    return {0, local.slope > 0 ? RadiusBound::leaves : RadiusBound::unlit};
  }
  const double a = relief::worldPerHeight(relief.space, frame);
  const double texel = local.worldPerTexel;
  const Vec3 along = local.direction.x * frame.px + local.direction.y * frame.py;
  const RayWay way{surface::normalCurvature(point, along),
                   local.slope,
                   a * relief.field.minimum(),
                   a * relief.field.maximum(),
                   texel * relief.field.knownLength(frame.texel, local.direction),
                   diagonal,
                   texel * std::hypot(relief.field.width(), relief.field.height())};
  const RayEnd end = endOf(way);
  return {end.distance / texel, end.bound};
}

}  // namespace

RayEnd endOf(const RayWay& way) {
  if (isDark(way)) return {0, RadiusBound::unlit};
  RayEnd end{way.border, RadiusBound::border};
  const auto limit = [&end](double distance, RadiusBound bound) {
    if (distance < end.distance) end = {distance, bound};
  };
  limit(0.5 * pi / std::abs(way.curvature), RadiusBound::quarterTurn);
  limit(way.size, RadiusBound::size);
  const Leave leave = leaveOf(way);
  const bool isBack = leave.back < end.distance;
  if (leave.at < end.distance && !isBack) return {leave.at, RadiusBound::leaves};
  limit(way.tile, RadiusBound::tile);
  return end;
}

SearchRadius searchRadius(const surface::LimitSurface& surface, const relief::Relief& relief,
                          std::span<const Vec3> lights) {
  constexpr double points = 16384;
  const auto faces = static_cast<std::size_t>(surface.faceCount());
  const int side = std::max(1, static_cast<int>(std::sqrt(points / static_cast<double>(faces))));
  const double farthest = diagonal(surface, side);
  std::vector<SearchRadius> found(faces, SearchRadius{0});
  parallelFor(
      0, faces,
      [&](std::size_t face) {
        Face(surface, static_cast<int>(face), side).forEach([&](const surface::LimitPoint& point) {
          const surface::TexelFrame frame = surface::texelFrame(point, relief.texelsPerUv());
          if (!frame.defined) return;
          throwIfCancelled();
          for (std::size_t l = 0; l < lights.size(); ++l) {
            SearchRadius radius = radiusAt(point, frame, relief, lights[l], farthest);
            radius.light = l;
            take(found[face], radius);
          }
        });
      },
      64);
  SearchRadius all{0};
  for (const SearchRadius& radius : found) take(all, radius);
  all.texels = std::clamp(std::ceil(all.texels), 1.0, mostTexels);
  return all;
}

}  // namespace gnomon::horizon
