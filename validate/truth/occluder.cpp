#include "truth/occluder.h"

#include "truth/sample_place.h"

namespace gnomon {

std::optional<Occluder> firstOccluder(const LimitSurface& surface, const Relief& relief,
                                      const MicroMesh& mesh, const MicroScene& scene,
                                      const OccluderQuery& query) {
  const SamplePlace place = samplePlace(surface, relief.texelsPerUv(), mesh, query.sample);
  if (!place.defined) return std::nullopt;
  if (glm::dot(place.facetNormal, query.light) <= 0) return Occluder{place.point, 0, true};
  const Vec3 origin =
      place.point - mesh.centre() + query.liftShare * mesh.extent() * place.facetNormal;
  const auto hit = scene.nearest(origin, query.light);
  if (!hit) return std::nullopt;
  return Occluder{mesh.centre() + origin + hit->distance * query.light, hit->distance, false};
}

}  // namespace gnomon
