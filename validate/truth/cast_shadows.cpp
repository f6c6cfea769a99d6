#include "truth/cast_shadows.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "common/parallel.h"
#include "truth/flush_denormals.h"

namespace gnomon::truth {
namespace {

/// Below a hit of a ray; world coordinates.
PathTarget targetOf(const surface::LimitSurface& surface, const MicroMesh& mesh,
                    const SurfaceHit& hit, const Vec3& occluder) {
  const surface::SurfaceSample below = mesh.parametersAt(hit.face, hit.place);
  const surface::TangentPoint point = surface.tangentPoint(below);
  return {point.position, surface::outwardNormal(point), hit.face,
          2 * glm::length(occluder - point.position)};
}

/// A sample on the mesh.
struct Placed {
  RayStart start;
  TexelAxes axes;
};

Placed placedBy(SamplePlacer& placer, const surface::SurfaceSample& sample) {
  const SamplePlace place = placer.place(sample);
  return {rayStart(place), {place.frame.px, place.frame.py}};
}

}  // namespace

void splitCastShadows(const surface::LimitSurface& surface, const relief::Relief& relief,
                      const MicroMesh& mesh, const MicroScene& scene, const SurfacePaths& paths,
                      const CastShadowSettings& settings, const surface::SampleGrid& samples,
                      std::span<const TraceSettings> lights, std::span<Truth> truths,
                      const PlacedSamples* placed) {
  const std::span<const int> parts = settings.parts;
  const std::size_t count = samples.samples.size();
  if (!parts.empty()) {
    for (Truth& truth : truths) truth.casters.assign(count, noCaster);
  }
  // The region of a sample whose ray first meets the surface there.
  const auto regionBy = [&](const surface::SurfaceSample& sample, const Placed& from,
                            const Vec3& origin, const Vec3& light, const SurfaceHit& hit) {
    const Vec3 occluder = mesh.centre() + origin + hit.distance * light;
    const bool isOnPath =
        paths.leadTo({sample, from.start.normal, light}, targetOf(surface, mesh, hit, occluder));
    if (!isOnPath) return Region::global;
    const double reach = rayLength(from.start.normal, from.axes, light, settings.radiusTexels);
    return hit.distance > reach ? Region::distant : Region::cast;
  };
  constexpr std::size_t piece = 256;
  parallelFor(0, (count + piece - 1) / piece, [&](std::size_t p) {
    const FlushDenormals flush;
    SamplePlacer placer(surface, relief.texelsPerUv(), mesh);
    for (std::size_t i = p * piece; i < std::min(count, (p + 1) * piece); ++i) {
      throwIfCancelled();
      const auto isCast = [&](const Truth& truth) { return truth.regions[i] == Region::cast; };
      if (std::none_of(truths.begin(), truths.end(), isCast)) continue;
      const surface::SurfaceSample& sample = samples.samples[i];
      const Placed from =
          placed != nullptr ? Placed{placed->starts[i], placed->axes[i]} : placedBy(placer, sample);
      for (std::size_t l = 0; l < lights.size(); ++l) {
        if (!isCast(truths[l])) continue;
        const Vec3& light = lights[l].light.direction;
        const Vec3 origin = from.start.facet.rayOrigin(mesh.rayOffset(lights[l].rayOffset));
        const auto hit = scene.nearest(origin, light);
        if (!hit) continue;  // a ray that grazes an edge
        if (!parts.empty()) {
          truths[l].casters[i] =
              static_cast<std::uint8_t>(parts[static_cast<std::size_t>(hit->face)]);
        }
        truths[l].regions[i] = regionBy(sample, from, origin, light, *hit);
      }
    }
  });
}

}  // namespace gnomon::truth
