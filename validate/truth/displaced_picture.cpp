#include "truth/displaced_picture.h"

#include <algorithm>
#include <array>

#include "common/parallel.h"
#include "truth/embree.h"

namespace gnomon::truth {

namespace {

/// Lights some of the points of a picture. Rays wait until sixteen neighbours are there.
class PointLighter {
 public:
  PointLighter(const SeenSurface& seen, const MicroScene& scene, const Vec3& light,
               std::vector<float>& picture)
      : seen_(seen), scene_(scene), light_(light), picture_(picture) {}

  void add(std::size_t i) {
    const SeenSurface::Point& point = seen_.points[i];
    if (!point.isThere) return;
    picture_[i] = 0;
    if (point.facet.facesAwayFrom(light_)) return;
    pixels_[rays_.count] = i;
    rays_.add(point.facet.rayOrigin(seen_.rayOffset));
    if (rays_.count == RayPacket::size) trace();
  }

  void trace() {
    if (rays_.count == 0) return;
    const auto blocked = scene_.occluded(rays_, light_);
    for (std::size_t k = 0; k < rays_.count; ++k) {
      if (blocked[k]) continue;
      const Facet& facet = seen_.points[pixels_[k]].facet;
      picture_[pixels_[k]] = static_cast<float>(glm::dot(facet.normal, light_));
    }
    rays_.count = 0;
  }

 private:
  const SeenSurface& seen_;
  const MicroScene& scene_;
  const Vec3& light_;
  std::vector<float>& picture_;
  RayPacket rays_{};
  std::array<std::size_t, RayPacket::size> pixels_{};
};

}  // namespace

std::vector<float> displacedPicture(const MicroMesh& mesh, const MicroScene& scene,
                                    const Camera& camera, const Vec3& light,
                                    const Progress& progress) {
  return displacedPicture(seenSurface(mesh, scene, camera, progress), scene, light);
}

SeenSurface seenSurface(const MicroMesh& mesh, const MicroScene& scene, const Camera& camera,
                        const Progress& progress) {
  const auto width = static_cast<std::size_t>(camera.width);
  const auto height = static_cast<std::size_t>(camera.height);
  const CameraAxes axis = axes(camera);
  const Vec3 eye = camera.eye - mesh.centre();
  // Primary hits are found by a float ray: the offset covers its rounding at the eye's distance.
  SeenSurface seen{camera.width, camera.height, 4e-6 * std::max(mesh.extent(), glm::length(eye)),
                   RawVector<SeenSurface::Point>(width * height)};
  CountedProgress rows(progress, height);
  parallelFor(0, height, [&](std::size_t row) {
    const FlushDenormals flush;
    for (std::size_t column = 0; column < width; ++column) {
      const Vec3 direction =
          pixelDirection(camera, axis, static_cast<int>(column), static_cast<int>(row));
      const auto hit = scene.nearest(eye, direction);
      SeenSurface::Point& point = seen.points[row * width + column];
      point.isThere = hit.has_value();
      if (hit) point.facet = {eye + hit->distance * direction, hit->normal};
    }
    rows.advance();
  });
  return seen;
}

std::vector<float> displacedPicture(const SeenSurface& seen, const MicroScene& scene,
                                    const Vec3& light, const Progress& progress) {
  const auto width = static_cast<std::size_t>(seen.width);
  const auto height = static_cast<std::size_t>(seen.height);
  std::vector<float> picture(width * height, -1.0F);
  constexpr std::size_t side = 4;
  const std::size_t bands = (height + side - 1) / side;
  CountedProgress done(progress, bands);
  parallelFor(0, bands, [&](std::size_t band) {
    const FlushDenormals flush;
    PointLighter lighter(seen, scene, light, picture);
    for (std::size_t left = 0; left < width; left += side) {
      for (std::size_t row = band * side; row < std::min(height, (band + 1) * side); ++row) {
        for (std::size_t column = left; column < std::min(width, left + side); ++column) {
          lighter.add(row * width + column);
        }
      }
    }
    lighter.trace();
    done.advance();
  });
  return picture;
}

}  // namespace gnomon::truth
