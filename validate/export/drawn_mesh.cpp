#include "export/drawn_mesh.h"

#include <fmt/core.h>

#include <algorithm>

#include "export/sample_map.h"
#include "image/images.h"
#include "truth/displaced_picture.h"

namespace gnomon::exporting {
namespace {

image::ChannelImage mapOf(const truth::SeenSurface& seen, const Vec3& centre) {
  image::ChannelImage map{seen.width,
                          seen.height,
                          {"point.X", "point.Y", "point.Z", "facet.X", "facet.Y", "facet.Z"},
                          {}};
  map.values.reserve(6 * seen.points.size());
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const truth::SeenSurface::Point& seenPoint = seen.points[i];
    const Vec3 point = seenPoint.isThere ? seenPoint.facet.point + centre : Vec3(0);
    const Vec3 normal = seenPoint.isThere ? seenPoint.facet.normal : Vec3(0);
    for (const Vec3& vector : {point, normal}) {
      for (int k = 0; k < 3; ++k) map.values.push_back(static_cast<float>(vector[k]));
    }
  }
  return map;
}

/// @param light  as displacedPicture
Mask maskOf(const truth::SeenSurface& seen, const std::vector<float>& light) {
  Mask mask{seen.width, seen.height, std::vector<Shade>(light.size())};
  std::transform(light.begin(), light.end(), mask.samples.begin(), [](float value) {
    return value < 0 ? Shade::none : value > 0 ? Shade::lit : Shade::shadowed;
  });
  return mask;
}

}  // namespace

std::string drawnMapFile(const study::CaseNames& names, std::size_t view) {
  return fmt::format("drawn/samples/{}.exr", names.views[view]);
}

std::string drawnMaskFile(const study::CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("drawn/masks/{}_{}_truth.png", names.views[view], names.lights[light]);
}

void writeDrawnMesh(report::RunFolder& folder, const study::RunScene& scene,
                    const study::TracedSurface& surface) {
  const study::CaseNames names = study::caseNames(scene.study);
  for (std::size_t v = 0; v < scene.study.views.size(); ++v) {
    const Camera* camera = cameraOf(scene.study.views[v]);
    if (camera == nullptr) continue;
    const truth::SeenSurface seen = truth::seenSurface(surface.mesh, surface.scene, *camera);
    writeSampleMap(folder, drawnMapFile(names, v), mapOf(seen, surface.mesh.centre()));
    for (std::size_t l = 0; l < scene.study.lights.size(); ++l) {
      const std::vector<float> light =
          truth::displacedPicture(seen, surface.scene, scene.study.lights[l].direction());
      folder.write(drawnMaskFile(names, v, l), image::pngOf(image::maskImage(maskOf(seen, light))));
    }
  }
}

}  // namespace gnomon::exporting
