#include "study/run/scene/view_map.h"

#include <cmath>

namespace gnomon {

ViewMap::ViewMap(const LimitSurface& surface, const RenderView& view)
    : view_(view), clip_(view.clipFromWorld) {
  if (isAtlas()) samplesPerSide_ = view.width / view.atlasTiles.x;
  if (isAtlas() && !surface.grid()) tileSide_ = samplesPerSide_;
}

Vec2 ViewMap::image(const TangentPoint& point, const Vec3& tangent) const {
  return isAtlas() ? imageInAtlas(point, tangent) : imageInCamera(point.position, tangent);
}

Vec2 ViewMap::imageInAtlas(const TangentPoint& point, const Vec3& tangent) const {
  const double ss = glm::dot(point.ds, point.ds);
  const double st = glm::dot(point.ds, point.dt);
  const double tt = glm::dot(point.dt, point.dt);
  const double s = glm::dot(point.ds, tangent);
  const double t = glm::dot(point.dt, tangent);
  const Vec2 parameters = Vec2(tt * s - st * t, ss * t - st * s) / (ss * tt - st * st);
  return static_cast<double>(samplesPerSide_) * Vec2(parameters.x, -parameters.y);
}

/// The derivative of (x/w, y/w) is ((x', y') - w' (x/w, y/w)) / w.
Vec2 ViewMap::imageInCamera(const Vec3& position, const Vec3& tangent) const {
  const glm::dvec4 at = clip_ * glm::dvec4(position, 1);
  const glm::dvec4 motion = clip_ * glm::dvec4(tangent, 0);
  const Vec2 device = (Vec2(motion) - motion.w * Vec2(at) / at.w) / at.w;
  return device * Vec2(view_.width, -view_.height) / 2.0;
}

double sampleSpacing(Vec2 image, Vec2 imageAcross) {
  // The inverse of the matrix with these two columns: what a column and a row are in the world.
  const double area = image.x * imageAcross.y - image.y * imageAcross.x;
  const double column = std::hypot(imageAcross.y, image.y) / std::abs(area);
  const double row = std::hypot(imageAcross.x, image.x) / std::abs(area);
  constexpr double roundingSamples = 3;
  return roundingSamples * (column + row);
}

}  // namespace gnomon
