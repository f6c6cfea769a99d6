#include "model/field_lines.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/parallel.h"
#include "surface/curvature.h"

namespace gnomon::app {
namespace {

/// Whether the directions have a meaning, on a face of this size.
bool hasDirections(const surface::PrincipalCurvatures& curvatures, double faceSize) {
  const double difference = curvatures.k1 - curvatures.k2;
  const double larger = std::max(std::abs(curvatures.k1), std::abs(curvatures.k2));
  return std::isfinite(difference) && difference > 5e-3 * larger && difference * faceSize > 1e-6;
}

void addLines(const surface::LimitPoint& point, const LineSettings& settings,
              PrincipalLines& lines) {
  const Vec3 normal = surface::outwardNormal(point);
  if (normal == Vec3(0)) return;
  const surface::PrincipalCurvatures curvatures = surface::principalCurvatures(point);
  const double longer = std::max(glm::length(point.ds), glm::length(point.dt));
  if (!hasDirections(curvatures, longer)) return;
  // Of two neighbours along the shorter side, so that lines do not meet.
  const double shorter = std::min(glm::length(point.ds), glm::length(point.dt));
  const double spacing = shorter / settings.perFaceSide;
  const Vec3 middle = point.position + settings.liftShare * spacing * normal;
  const auto through = [&](const Vec3& direction) {
    const Vec3 half = 0.5 * settings.lengthShare * spacing * direction;
    return LineSegment{middle - half, middle + half};
  };
  lines.larger.push_back(through(curvatures.v1));
  lines.smaller.push_back(through(curvatures.v2));
}

std::uint8_t mixed(std::uint8_t from, std::uint8_t to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
}

}  // namespace

PrincipalLines principalLines(const surface::LimitSurface& surface, const LineSettings& settings) {
  constexpr double most = 1 << 24;
  const int side = settings.perFaceSide;
  if (side < 1 || static_cast<double>(side) * side * surface.faceCount() > most) {
    throw InputError(
        fmt::format("principal directions: {} x {} lines on each of {} faces, 1 to {} "
                    "lines expected",
                    side, side, surface.faceCount(), most));
  }
  PrincipalLines lines;
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        addLines(surface.evaluate(face, (i + 0.5) / side, (j + 0.5) / side), settings, lines);
      }
    }
  }
  return lines;
}

CurvatureField curvatureAlong(const surface::LimitSurface& surface,
                              const surface::SampleGrid& samples, const Vec3& light) {
  CurvatureField field;
  field.values.assign(samples.samples.size(), 0);
  field.defined.assign(samples.samples.size(), 0);
  constexpr std::size_t grain = 1024;
  parallelFor(
      0, samples.samples.size(),
      [&](std::size_t i) {
        const surface::SurfaceSample& sample = samples.samples[i];
        if (!sample.isOnSurface()) return;
        const surface::LimitPoint point = surface.evaluate(sample);
        const Vec3 normal = surface::outwardNormal(point);
        const Vec3 along = light - glm::dot(light, normal) * normal;
        if (normal == Vec3(0) || !(glm::length(along) > 1e-12)) return;
        const double value = surface::normalCurvature(point, light);
        if (!std::isfinite(value)) return;
        field.values[i] = value;
        field.defined[i] = 1;
      },
      grain);
  for (const double value : field.values) field.largest = std::max(field.largest, std::abs(value));
  return field;
}

image::Rgb curvatureColour(double value, double largest) {
  const image::Rgb flat = CurvatureColours::flat;
  if (!(largest > 0) || !std::isfinite(value)) return flat;
  const image::Rgb end = value < 0 ? CurvatureColours::concave : CurvatureColours::convex;
  const double share = std::min(std::abs(value) / largest, 1.0);
  return {mixed(flat[0], end[0], share), mixed(flat[1], end[1], share),
          mixed(flat[2], end[2], share)};
}

}  // namespace gnomon::app
