#include "study/run/scene/view_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/parallel.h"
#include "study/run/scene/view_map.h"
#include "surface/limit_face.h"

namespace gnomon {
namespace {

/// Where a sample is, and how far a neighbour can be.
struct Surrounding {
  glm::vec3 place{0};
  float spacing = 0;
};

Surrounding surroundingOf(const ViewMap& map, const TangentPoint& point) {
  const Vec3 normal = outwardNormal(point);
  const Vec3 along = glm::normalize(point.ds);
  const Vec3 across = glm::cross(normal, along);
  const double spacing = sampleSpacing(map.image(point, along), map.image(point, across));
  return {glm::vec3(point.position), std::isfinite(spacing)
                                         ? static_cast<float>(spacing)
                                         : std::numeric_limits<float>::infinity()};
}

bool isBreak(const Surrounding& a, const Surrounding& b) {
  return glm::distance(a.place, b.place) > std::min(a.spacing, b.spacing);
}

std::vector<std::uint8_t> breaksInCamera(const LimitSurface& surface, const ViewMap& map,
                                         const SampleGrid& grid) {
  const std::vector<LimitFace> faces = limitFaces(surface, grid.samples.size());
  std::vector<Surrounding> surroundings(grid.samples.size());
  constexpr std::size_t grain = 1024;
  parallelFor(
      0, surroundings.size(),
      [&](std::size_t i) {
        const SurfaceSample& sample = grid.samples[i];
        if (!sample.isOnSurface()) return;
        const LimitFace& face = faces[sample.faceIndex()];
        surroundings[i] = surroundingOf(map, face.at(sample.s, sample.t));
      },
      grain);
  const auto width = static_cast<std::size_t>(grid.width);
  std::vector<std::uint8_t> breaks(surroundings.size());
  parallelFor(
      0, breaks.size(),
      [&](std::size_t i) {
        const auto parts = [&](std::size_t neighbour) {
          return grid.samples[i].face >= 0 && grid.samples[neighbour].face >= 0 &&
                 isBreak(surroundings[i], surroundings[neighbour]);
        };
        if ((i + 1) % width != 0 && parts(i + 1)) breaks[i] |= breakRight;
        if (i + width < breaks.size() && parts(i + width)) breaks[i] |= breakBelow;
      },
      grain);
  return breaks;
}

/// Columns and rows in texels.
Vec2 meanSteps(const LimitSurface& surface, Vec2 texelsPerUv, int samplesPerSide) {
  Vec2 sum(0);
  for (int face = 0; face < surface.faceCount(); ++face) {
    const TangentPoint middle = surface.tangentPoint(face, 0.5, 0.5);
    sum += Vec2(glm::length(texelsPerUv * middle.uvDs), glm::length(texelsPerUv * middle.uvDt));
  }
  return sum / (static_cast<double>(surface.faceCount()) * samplesPerSide);
}

}  // namespace

SampleLayout makeSampleLayout(const LimitSurface& surface, Vec2 texelsPerUv, const RenderView& view,
                              const SampleGrid& samples) {
  const ViewMap map(surface, view);
  if (!map.isAtlas()) return {1, 1, 0, breaksInCamera(surface, map, samples)};
  const Vec2 steps = meanSteps(surface, texelsPerUv, map.samplesPerSide());
  return {steps.x, steps.y, map.tileSide(), {}};
}

}  // namespace gnomon
