#include "truth/occluder.h"

#include "truth/sample_place.h"

namespace gnomon::truth {

std::optional<Occluder> firstOccluder(const surface::LimitSurface& surface,
                                      const relief::Relief& relief, const MicroMesh& mesh,
                                      const MicroScene& scene, const OccluderQuery& query) {
  SamplePlacer placer(surface, relief.texelsPerUv(), mesh);
  const SamplePlace place = placer.place(query.sample);
  if (!place.defined) return std::nullopt;
  const Facet& facet = place.facet;
  if (facet.facesAwayFrom(query.light)) {
    return Occluder{mesh.centre() + facet.point, 0, true};
  }
  const Vec3 origin = facet.rayOrigin(mesh.rayOffset(query.rayOffset));
  const auto hit = scene.nearest(origin, query.light);
  if (!hit) return std::nullopt;
  return Occluder{mesh.centre() + origin + hit->distance * query.light, hit->distance, false};
}

}  // namespace gnomon::truth
