#include "export/drawn_mesh.h"

#include <fmt/core.h>

#include <algorithm>

#include "export/sample_map.h"
#include "export/truth_files.h"
#include "truth/displaced_picture.h"
#include "truth/visibility_tracer.h"

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

/// @param directions  toward the disc of a light that has one
truth::Truth truthOf(const truth::SeenSurface& seen, const truth::MicroScene& scene,
                     const Light& light, int directions) {
  truth::Truth found;
  found.mask = maskOf(seen, truth::displacedPicture(seen, scene, light.direction));
  if (light.isSoft()) {
    found.answerBy(truth::traceVisibility(seen, scene, found.mask, {light, directions}));
  }
  return found;
}

}  // namespace

std::string drawnMapFile(const study::CaseNames& names, std::size_t view) {
  return fmt::format("drawn/samples/{}.exr", names.views[view]);
}

std::string drawnMaskFile(const study::CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("drawn/masks/{}_{}_truth.png", names.views[view], names.lights[light]);
}

std::string drawnShareFile(const study::CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("drawn/shares/{}_{}_truth.exr", names.views[view], names.lights[light]);
}

DrawnTruths writeDrawnMesh(report::RunFolder& folder, const study::RunScene& scene,
                           const study::TracedSurface& surface) {
  const study::StudySpec& study = scene.study;
  const study::CaseNames names = study::caseNames(study);
  DrawnTruths drawn(study.views.size());
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    const Camera* camera = cameraOf(study.views[v]);
    if (camera == nullptr) continue;
    const truth::SeenSurface seen = truth::seenSurface(surface.mesh, surface.scene, *camera);
    writeSampleMap(folder, drawnMapFile(names, v), mapOf(seen, surface.mesh.centre()));
    for (std::size_t l = 0; l < study.lights.size(); ++l) {
      drawn[v].push_back(truthOf(seen, surface.scene, study.lights[l], study.truth.directions));
      writeTruthMask(folder, drawn[v].back(), drawnMaskFile(names, v, l),
                     drawnShareFile(names, v, l));
    }
  }
  return drawn;
}

std::vector<std::vector<double>> drawnUncertainties(const study::RunScene& scene,
                                                    const study::TracedSurface& coarse,
                                                    const DrawnTruths& drawn) {
  const study::StudySpec& study = scene.study;
  std::vector<std::vector<double>> uncertainties(study.views.size());
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    const Camera* camera = cameraOf(study.views[v]);
    if (camera == nullptr) continue;
    truth::SeenSurface seen = truth::seenSurface(coarse.mesh, coarse.scene, *camera);
    seen.rayOffset /= 2;
    for (std::size_t l = 0; l < study.lights.size(); ++l) {
      const truth::Truth other =
          truthOf(seen, coarse.scene, study.lights[l], study.truth.directions / 2);
      uncertainties[v].push_back(truth::uncertaintyOf(drawn[v][l], other));
    }
  }
  return uncertainties;
}

}  // namespace gnomon::exporting
