#include "truth/sample_place.h"

#include "surface/texel_frame.h"

namespace gnomon {

SamplePlace samplePlace(const LimitSurface& surface, Vec2 texelsPerUv, const MicroMesh& mesh,
                        const SurfaceSample& sample) {
  if (sample.face < 0) return {};
  const TexelFrame frame =
      texelFrame(surface.evaluate(sample.face, sample.s, sample.t), texelsPerUv);
  const Facet facet = mesh.facet(sample.face, sample.s, sample.t);
  if (!frame.defined || facet.normal == Vec3(0)) return {};
  return {true,        frame.position, frame.normal, frame.texel, facet.point + mesh.centre(),
          facet.normal};
}

}  // namespace gnomon
