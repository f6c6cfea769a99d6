#include "model/cross_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/mask.h"
#include "common/parallel.h"
#include "surface/curvature.h"
#include "surface/texel_frame.h"

namespace gnomon::app {

namespace {

/// sin γ / γ, 1 at 0.
double sinc(double angle) {
  return std::abs(angle) < 1e-8 ? 1 : std::sin(angle) / angle;
}

/// The elevation of a ray of the plane over the tangent plane, radians.
double elevationOf(Vec2 ray) {
  return std::atan2(ray.y, ray.x);
}

Vec2 rayAt(double elevation) {
  return {std::cos(elevation), std::sin(elevation)};
}

SectionHorizons formulasOn(const horizon::HorizonLookups& at, const CrossSection& section) {
  const auto horizon = [&](double slope) {
    const bool shadowed = !(section.lightSlope > slope);
    const double over = elevationOf(section.lightDirection) - CrossSection::angle(slope);
    const double share = section.lightRadius > 0 ? discShare(over / section.lightRadius)
                         : shadowed              ? 0
                                                 : 1;
    return SectionHorizon{slope, shadowed, share};
  };
  SectionHorizons all;
  all.lookups = at;
  all.flat = horizon(at.slope);
  all.smallAngle = horizon(horizon::smallAngleHorizon(at));
  all.unreduced = horizon(horizon::unreducedHorizon(at));
  all.exact = horizon(horizon::osculatingHorizon(at));
  all.bare = horizon(horizon::bareHorizon(at.curvature, at.height));
  all.onoue2004 = all.smallAngle.shadowed || all.bare.shadowed;
  all.onoueExact = all.exact.shadowed || all.bare.shadowed;
  all.onoue2004Share = std::min(all.smallAngle.share, all.bare.share);
  all.onoueExactShare = std::min(all.exact.share, all.bare.share);
  all.onoue2003 = at.curvature > 0 ? all.onoue2004 : all.flat.shadowed;
  return all;
}

/// A flat horizon in the world.
horizon::HorizonLookups inWorld(const CrossSection& section, const horizon::FlatHorizon& horizon) {
  return {section.curvature, section.eye.y,
          section.worldPerHeight * horizon.slope / section.worldPerTexel,
          section.worldPerTexel * horizon.distance};
}

/// The relief and the ground below it on the circle, up to a quarter turn.
void bend(CrossSection& section) {
  for (const horizon::ProfilePoint& point : section.profile.points) {
    const double arc = section.worldPerTexel * point.distance;
    if (std::abs(section.curvature * arc) > pi / 2) continue;
    const double height = section.worldPerHeight * point.height;
    section.bentRelief.push_back(onOsculatingCircle(section.curvature, arc, height));
    section.bentGround.push_back(onOsculatingCircle(section.curvature, arc, 0));
  }
}

}  // namespace

double CrossSection::angle(double slope) {
  return std::atan(slope);
}

Vec2 CrossSection::inPlane(const Vec3& world) const {
  return {glm::dot(world - origin, along), glm::dot(world - origin, up)};
}

Vec2 onOsculatingCircle(double curvature, double arcLength, double height) {
  // 1/κ sin γ and 1/κ (1 - cos γ) without 1/κ.
  const double angle = curvature * arcLength;
  const double run = arcLength * sinc(angle);
  const double drop = arcLength * std::sin(angle / 2) * sinc(angle / 2);
  return {run + height * std::sin(angle), height * std::cos(angle) - drop};
}

std::optional<CrossSection> crossSection(const surface::LimitSurface& surface,
                                         const relief::Relief& relief,
                                         const surface::SurfaceSample& sample, const Vec3& light,
                                         const SectionSettings& settings,
                                         const SectionTables* tables) {
  if (!sample.isOnSurface()) return std::nullopt;
  const surface::LimitPoint point = surface.evaluate(sample);
  const surface::TexelFrame frame = surface::texelFrame(point, relief.texelsPerUv());
  if (!frame.defined) return std::nullopt;
  const surface::LocalLight local = surface::localLight(frame, light);

  CrossSection section;
  section.origin = frame.position;
  section.up = frame.normal;
  section.along =
      (local.direction.x * frame.px + local.direction.y * frame.py) / local.worldPerTexel;
  section.curvature = surface::normalCurvature(point, section.along);
  section.worldPerTexel = local.worldPerTexel;
  section.worldPerHeight = relief::worldPerHeight(relief.space, frame);
  section.lightSlope = local.slope;
  section.lightDirection = {glm::dot(light, section.along), glm::dot(light, section.up)};
  section.lightRadius = settings.lightRadius;
  section.lowestRay = rayAt(elevationOf(section.lightDirection) - settings.lightRadius);
  section.highestRay = rayAt(elevationOf(section.lightDirection) + settings.lightRadius);

  section.profile = horizon::heightProfile(relief.field, frame.texel, local.direction,
                                           settings.radiusTexels, settings.behindTexels);
  section.horizon =
      horizon::flatHorizon(relief.field, frame.texel, local.direction, settings.radiusTexels);
  section.eye = {0, section.worldPerHeight * relief.field.at(frame.texel)};
  const horizon::HorizonLookups here = inWorld(section, section.horizon);
  section.here = formulasOn(here, section);
  if (tables != nullptr) {
    const auto entry = [&](const horizon::StoredTable& table) {
      return horizon::filteredValue(table, tables->shape, frame.texel, local.azimuth());
    };
    const horizon::FlatHorizon filtered{entry(tables->horizon), entry(tables->distance)};
    section.fromTables = formulasOn(inWorld(section, filtered), section);
  }
  bend(section);
  section.horizonPoint =
      onOsculatingCircle(here.curvature, here.arcLength, here.height + here.slope * here.arcLength);
  return section;
}

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
