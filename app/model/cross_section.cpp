#include "model/cross_section.h"

#include <algorithm>
#include <cmath>

#include "common/disc_share.h"
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

}  // namespace gnomon::app
