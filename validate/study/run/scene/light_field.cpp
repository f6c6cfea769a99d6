#include "study/run/scene/light_field.h"

#include <cmath>

#include "common/parallel.h"
#include "study/run/scene/view_map.h"

namespace gnomon::study {
namespace {

FieldPoint fieldPoint(const ViewMap& map, const surface::LimitSurface& surface,
                      const surface::SurfaceSample& sample) {
  const surface::TangentPoint point = surface.tangentPoint(sample);
  const Vec3 normal = surface::outwardNormal(point);
  return {point.position, point.ds, point.dt, normal,
          static_cast<float>(sampleSpacing(map, point, normal))};
}

compare::LightStep lightStep(const ViewMap& map, const FieldPoint& at, const Vec3& light) {
  constexpr double leastSine = 1e-6;
  const Vec3& normal = at.normal;
  const double cosine = glm::dot(light, normal);
  const Vec3 toLight = light - cosine * normal;
  if (normal == Vec3(0) || !(cosine > 0) || !(glm::length(toLight) > leastSine)) return {};

  const Vec3 along = -glm::normalize(toLight);
  const surface::TangentPoint point{at.position, at.ds, at.dt, Vec2(0), Vec2(0), Vec2(0)};
  const Vec2 image = map.image(point, along);
  const double speed = glm::length(image);
  if (!std::isfinite(at.spacing) || !(speed > 0)) return {};
  return {glm::vec2(image / speed), static_cast<float>(1 / speed), glm::vec3(point.position),
          at.spacing};
}

/// @param pointOf  `pointOf(i)` is a sample's
template <typename PointOf>
compare::LightField lightFieldOf(const ViewMap& map, const surface::SampleGrid& samples,
                                 const PointOf& pointOf, const Vec3& light) {
  compare::LightField field{samples.width, samples.height, map.tileSide(),
                            RawVector<compare::LightStep>(samples.samples.size())};
  parallelFor(
      0, field.steps.size(),
      [&](std::size_t i) {
        field.steps[i] = samples.samples[i].isOnSurface() ? lightStep(map, pointOf(i), light)
                                                          : compare::LightStep{};
      },
      1024);
  return field;
}

}  // namespace

FieldPoints makeFieldPoints(const surface::LimitSurface& surface, const ViewKind& kind,
                            const render::RenderView& view, const surface::SampleGrid& samples) {
  const ViewMap map(surface, kind, view);
  FieldPoints points(samples.samples.size());
  parallelFor(
      0, points.size(),
      [&](std::size_t i) {
        const surface::SurfaceSample& sample = samples.samples[i];
        if (sample.isOnSurface()) points[i] = fieldPoint(map, surface, sample);
      },
      1024);
  return points;
}

compare::LightField makeLightField(const surface::LimitSurface& surface, const ViewKind& kind,
                                   const render::RenderView& view,
                                   const surface::SampleGrid& samples, const Vec3& light) {
  const ViewMap map(surface, kind, view);
  return lightFieldOf(
      map, samples, [&](std::size_t i) { return fieldPoint(map, surface, samples.samples[i]); },
      light);
}

compare::LightField makeLightField(const surface::LimitSurface& surface, const ViewKind& kind,
                                   const render::RenderView& view,
                                   const surface::SampleGrid& samples, const FieldPoints& points,
                                   const Vec3& light) {
  return lightFieldOf(
      ViewMap(surface, kind, view), samples,
      [&](std::size_t i) -> const FieldPoint& { return points[i]; }, light);
}

}  // namespace gnomon::study
