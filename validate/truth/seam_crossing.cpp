#include "truth/seam_crossing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/parallel.h"
#include "surface/texel_frame.h"
#include "truth/flush_denormals.h"

namespace gnomon::truth {
namespace {

constexpr double sameTexel = 1e-3;

double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// Whether a difference of texture coordinates leaves the relief as it is.
bool isPeriod(Vec2 difference, const relief::Relief& relief) {
  if (relief.field.wrap() == relief::Wrap::repeat) {
    const Vec2 map(relief.field.width(), relief.field.height());
    difference -= glm::round(difference / map) * map;
  }
  return glm::length(difference) < sameTexel;
}

double orientationOf(const std::array<Vec2, 4>& corners) {
  const double area = cross(corners[2] - corners[0], corners[3] - corners[1]);
  const double longest =
      std::max(glm::length(corners[2] - corners[0]), glm::length(corners[3] - corners[1]));
  return std::abs(area) > 1e-12 * longest * longest ? std::copysign(1.0, area) : 0.0;
}

}  // namespace

TextureCharts::TextureCharts(const surface::LimitSurface& surface, const relief::Relief& relief) {
  const Vec2 texelsPerUv = relief.texelsPerUv();
  faces_.resize(static_cast<std::size_t>(surface.faceCount()));
  for (int face = 0; face < surface.faceCount(); ++face) {
    Face& own = faces_[static_cast<std::size_t>(face)];
    constexpr std::array places = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    for (std::size_t corner = 0; corner < 4; ++corner) {
      own.corners.at(corner) =
          surface.evaluate(face, places.at(corner).x, places.at(corner).y).uv * texelsPerUv;
    }
    own.orientation = orientationOf(own.corners);
  }
  for (const auto& [first, second] : surface::sharedSides(surface)) {
    const Side kind = connect(relief, first, second);
    connect(relief, second, first);
    seams_ += kind == Side::seam ? 1 : 0;
  }
}

TextureCharts::Side TextureCharts::connect(const relief::Relief& relief,
                                           const surface::FaceSide& side,
                                           const surface::FaceSide& otherSide) {
  Face& own = faces_[static_cast<std::size_t>(side.face)];
  const Face& other = faces_[static_cast<std::size_t>(otherSide.face)];
  // Neighbours run along their common edge in opposite directions.
  const auto corner = [](int k) { return static_cast<std::size_t>(k % 4); };
  const Vec2 atBegin =
      other.corners.at(corner(otherSide.side + 1)) - own.corners.at(corner(side.side));
  const Vec2 atEnd =
      other.corners.at(corner(otherSide.side)) - own.corners.at(corner(side.side + 1));
  const bool continued = glm::length(atBegin - atEnd) < sameTexel && isPeriod(atBegin, relief) &&
                         own.orientation != 0 && own.orientation == other.orientation;
  const Side kind = continued ? Side::continued : Side::seam;
  own.neighbours.at(corner(side.side)) = {kind, otherSide, atBegin};
  return kind;
}

bool TextureCharts::crossesSeam(const surface::SurfaceSample& sample, Vec2 direction,
                                double length) const {
  const Face* face = &faces_[sample.faceIndex()];
  const auto& [c0, c1, c2, c3] = face->corners;
  const double s = sample.s;
  const double t = sample.t;
  Vec2 origin = (1 - t) * ((1 - s) * c0 + s * c1) + t * ((1 - s) * c3 + s * c2);
  int entered = -1;
  double place = 0;  // along the line, texels
  for (std::size_t step = 0; step < 2 * faces_.size() + 8 && face->orientation != 0; ++step) {
    // The next side that the line leaves by. By its end points where it meets one between them; in
    // a corner rounding may miss both sides, and the nearest side's line decides (Cyrus & Beck
    // 1978).
    double left = std::numeric_limits<double>::infinity();
    double nearest = std::numeric_limits<double>::infinity();
    int side = -1;
    int nearestSide = -1;
    for (int k = 0; k < 4; ++k) {
      const Vec2 begin = face->corners.at(static_cast<std::size_t>(k));
      const Vec2 along = face->corners.at(static_cast<std::size_t>((k + 1) % 4)) - begin;
      const double outward = cross(direction, along);
      if (k == entered || !(face->orientation * outward > 0)) continue;
      const double at = cross(begin - origin, along) / outward;
      const double share = cross(begin - origin, direction) / outward;  // of the side
      if (at < nearest) {
        nearest = at;
        nearestSide = k;
      }
      if (share >= 0 && share <= 1 && at >= place - sameTexel && at < left) {
        left = at;
        side = k;
      }
    }
    if (side < 0) {
      left = nearest;
      side = nearestSide;
    }
    place = std::max(place, left);
    if (side < 0 || place >= length) return false;
    const Neighbour& next = face->neighbours.at(static_cast<std::size_t>(side));
    if (next.kind != Side::continued) return next.kind == Side::seam;
    origin += next.shift;
    entered = next.across.side;
    face = &faces_[static_cast<std::size_t>(next.across.face)];
  }
  return false;
}

std::vector<std::vector<std::uint8_t>> seamCrossings(
    const surface::LimitSurface& surface, const relief::Relief& relief, const MicroMesh& mesh,
    const MicroScene& scene, const TextureCharts& charts, const surface::SampleGrid& samples,
    std::span<const Truth> truths, std::span<const TraceSettings> lights, double radiusTexels) {
  const std::size_t count = samples.samples.size();
  std::vector<std::vector<std::uint8_t>> crosses(lights.size(),
                                                 std::vector<std::uint8_t>(count, 0));
  if (charts.seamCount() == 0) return crosses;
  const auto pathTexels = [&](const SamplePlace& place, bool lit, const surface::LocalLight& local,
                              const TraceSettings& light) {
    double world = 0;  // on the tangent plane
    if (lit) {
      const double below = relief::worldPerHeight(relief.space, place.frame) *
                           (relief.field.maximum() - relief.field.at(place.frame.texel));
      world = local.slope > 0 ? below / local.slope : std::numeric_limits<double>::infinity();
    } else if (const auto hit = scene.nearest(
                   place.facet.rayOrigin(mesh.rayOffset(light.rayOffset)), light.light.direction)) {
      world = hit->distance / std::hypot(1.0, local.slope);
    }
    return std::min(radiusTexels, world / local.worldPerTexel);
  };
  constexpr std::size_t piece = 256;
  parallelFor(0, (count + piece - 1) / piece, [&](std::size_t p) {
    const FlushDenormals flush;
    SamplePlacer placer(surface, relief.texelsPerUv(), mesh);
    for (std::size_t i = p * piece; i < std::min(count, (p + 1) * piece); ++i) {
      const SamplePlace place = placer.place(samples.samples[i]);
      if (!place.defined) continue;
      for (std::size_t l = 0; l < lights.size(); ++l) {
        if (place.facet.facesAwayFrom(lights[l].light.direction)) continue;
        const surface::LocalLight local =
            surface::localLight(place.frame, lights[l].light.direction);
        const bool lit = truths[l].mask.samples[i] == Shade::lit;
        const double length = pathTexels(place, lit, local, lights[l]);
        crosses[l][i] = charts.crossesSeam(place.sample, local.direction, length) ? 1 : 0;
      }
    }
  });
  return crosses;
}

}  // namespace gnomon::truth
