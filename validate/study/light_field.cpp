#include "study/light_field.h"

#include <cmath>

#include "common/parallel.h"

namespace gnomon {
namespace {

/// How a view shows the surroundings of a surface point.
class ViewMap {
 public:
  ViewMap(const LimitSurface& surface, const RenderView& view)
      : view_(view), clip_(view.clipFromWorld) {
    if (isAtlas()) samplesPerSide_ = view.width / view.atlasTiles.x;
    if (isAtlas() && !surface.grid()) tileSide_ = samplesPerSide_;
  }

  [[nodiscard]] int tileSide() const { return tileSide_; }

  /// Columns and rows a world unit along a tangent. Not finite where the view shows no such thing.
  [[nodiscard]] Vec2 image(const LimitPoint& point, const Vec3& tangent) const {
    return isAtlas() ? imageInAtlas(point, tangent) : imageInCamera(point.position, tangent);
  }

 private:
  [[nodiscard]] bool isAtlas() const { return view_.atlasTiles.x > 0; }

  [[nodiscard]] Vec2 imageInAtlas(const LimitPoint& point, const Vec3& tangent) const {
    const double ss = glm::dot(point.ds, point.ds);
    const double st = glm::dot(point.ds, point.dt);
    const double tt = glm::dot(point.dt, point.dt);
    const double s = glm::dot(point.ds, tangent);
    const double t = glm::dot(point.dt, tangent);
    const Vec2 parameters = Vec2(tt * s - st * t, ss * t - st * s) / (ss * tt - st * st);
    return static_cast<double>(samplesPerSide_) * Vec2(parameters.x, -parameters.y);
  }

  /// The derivative of (x/w, y/w) is ((x', y') - w' (x/w, y/w)) / w.
  [[nodiscard]] Vec2 imageInCamera(const Vec3& position, const Vec3& tangent) const {
    const glm::dvec4 at = clip_ * glm::dvec4(position, 1);
    const glm::dvec4 motion = clip_ * glm::dvec4(tangent, 0);
    const Vec2 device = (Vec2(motion) - motion.w * Vec2(at) / at.w) / at.w;
    return device * Vec2(view_.width, -view_.height) / 2.0;
  }

  const RenderView& view_;
  glm::dmat4 clip_;
  int samplesPerSide_ = 0;
  int tileSide_ = 0;
};

LightStep lightStep(const ViewMap& map, const LimitPoint& point, const Vec3& light) {
  constexpr double leastSine = 1e-6;
  const Vec3 normal = outwardNormal(point);
  const double cosine = glm::dot(light, normal);
  const Vec3 toLight = light - cosine * normal;
  if (normal == Vec3(0) || !(cosine > 0) || !(glm::length(toLight) > leastSine)) return {};

  const Vec3 along = -glm::normalize(toLight);
  const Vec3 across = glm::cross(normal, along);
  const Vec2 image = map.image(point, along);
  const Vec2 imageAcross = map.image(point, across);
  const double area = image.x * imageAcross.y - image.y * imageAcross.x;
  const double speed = glm::length(image);
  // The inverse of the matrix with these two columns: what a column and a row are in the world.
  const double column = std::hypot(imageAcross.y, image.y) / std::abs(area);
  const double row = std::hypot(imageAcross.x, image.x) / std::abs(area);
  if (!std::isfinite(column + row) || !(speed > 0)) return {};

  constexpr double roundingSamples = 3;
  return {glm::vec2(image / speed), static_cast<float>(1 / speed), glm::vec3(point.position),
          static_cast<float>(roundingSamples * (column + row))};
}

}  // namespace

LightField makeLightField(const LimitSurface& surface, const RenderView& view,
                          const SampleGrid& samples, const Vec3& light) {
  const ViewMap map(surface, view);
  LightField field{samples.width, samples.height, map.tileSide(),
                   std::vector<LightStep>(samples.samples.size())};
  parallelFor(
      0, field.steps.size(),
      [&](std::size_t i) {
        const SurfaceSample& sample = samples.samples[i];
        if (sample.face < 0) return;
        field.steps[i] = lightStep(map, surface.evaluate(sample.face, sample.s, sample.t), light);
      },
      1024);
  return field;
}

}  // namespace gnomon
