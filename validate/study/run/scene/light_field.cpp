#include "study/run/scene/light_field.h"

#include <cmath>

#include "common/parallel.h"
#include "study/run/scene/view_map.h"

namespace gnomon {
namespace {

LightStep lightStep(const ViewMap& map, const TangentPoint& point, const Vec3& light) {
  constexpr double leastSine = 1e-6;
  const Vec3 normal = outwardNormal(point);
  const double cosine = glm::dot(light, normal);
  const Vec3 toLight = light - cosine * normal;
  if (normal == Vec3(0) || !(cosine > 0) || !(glm::length(toLight) > leastSine)) return {};

  const Vec3 along = -glm::normalize(toLight);
  const Vec3 across = glm::cross(normal, along);
  const Vec2 image = map.image(point, along);
  const Vec2 imageAcross = map.image(point, across);
  const double speed = glm::length(image);
  const double spacing = sampleSpacing(image, imageAcross);
  if (!std::isfinite(spacing) || !(speed > 0)) return {};
  return {glm::vec2(image / speed), static_cast<float>(1 / speed), glm::vec3(point.position),
          static_cast<float>(spacing)};
}

}  // namespace

LightField makeLightField(const LimitSurface& surface, const ViewKind& kind, const RenderView& view,
                          const SampleGrid& samples, const Vec3& light) {
  const ViewMap map(surface, kind, view);
  LightField field{samples.width, samples.height, map.tileSide(),
                   RawVector<LightStep>(samples.samples.size())};
  parallelFor(
      0, field.steps.size(),
      [&](std::size_t i) {
        const SurfaceSample& sample = samples.samples[i];
        if (!sample.isOnSurface()) return;
        field.steps[i] = lightStep(map, surface.tangentPoint(sample), light);
      },
      1024);
  return field;
}

}  // namespace gnomon
