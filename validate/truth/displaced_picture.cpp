#include "truth/displaced_picture.h"

#include <algorithm>

#include "common/counted_progress.h"
#include "common/parallel.h"
#include "truth/flush_denormals.h"

namespace gnomon {

std::vector<float> displacedPicture(const MicroMesh& mesh, const MicroScene& scene,
                                    const Camera& camera, const Vec3& light,
                                    const Progress& progress) {
  const auto width = static_cast<std::size_t>(camera.width);
  const auto height = static_cast<std::size_t>(camera.height);
  const CameraAxes axis = axes(camera);
  const Vec3 eye = camera.eye - mesh.centre();
  // Primary hits are found by a float ray: the offset covers its rounding at the eye's distance.
  const double rayOffset = 4e-6 * std::max(mesh.extent(), glm::length(eye));
  std::vector<float> picture(width * height, -1.0F);
  CountedProgress rows(progress, height);
  parallelFor(0, height, [&](std::size_t row) {
    const FlushDenormals flush;
    for (std::size_t column = 0; column < width; ++column) {
      const Vec3 direction =
          pixelDirection(camera, axis, static_cast<int>(column), static_cast<int>(row));
      const auto hit = scene.nearest(eye, direction);
      if (!hit) continue;
      const Facet facet{eye + hit->distance * direction, hit->normal};
      const bool lit =
          !facet.facesAwayFrom(light) && !scene.occluded(facet.rayOrigin(rayOffset), light);
      picture[row * width + column] =
          lit ? static_cast<float>(glm::dot(facet.normal, light)) : 0.0F;
    }
    rows.advance();
  });
  return picture;
}

}  // namespace gnomon
