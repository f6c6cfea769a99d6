// The truth on planes whose texture is stretched, sheared or mirrored, against the closed form.

#include <gtest/gtest.h>

#include <cmath>

#include "truth/cast_shadows.h"
#include "truth/shadow_tracer.h"
#include "truth/truth_scenes.h"

namespace gnomon::truth {
namespace {

using test::ShearedPlane;
using test::shearedPlanes;
using test::stepRelief;

class ShearedTruth : public testing::TestWithParam<relief::HeightSpace> {};

/// A wall along the texture's y axis, 6 height units high, whose top ends at x = 31.5. Along the
/// light's direction e in the texture plane one texel is σ long, so that the shadow on the floor
/// ends 6 a |e_x| / (σ tan θ) texels from there.
TEST_P(ShearedTruth, WallsShadowEndsWhereTheMetricSays) {
  int shadows = 0;
  for (const ShearedPlane& plane : shearedPlanes()) {
    relief::Relief relief =
        stepRelief(plane.width, plane.height, 6, [](int i, int) { return i >= 28 && i < 32; });
    relief.space = GetParam();
    const surface::LimitSurface surface(plane.cage());
    const MicroMesh mesh(surface, relief, {plane.mirrored() ? 0.0625 : 0.25, 0});
    const MicroScene scene(mesh);
    for (const double azimuth : {180.0, 150.0, 215.0, 120.0}) {
      for (const double elevation : {50.0, 35.0, 25.0}) {
        const double a = radians(azimuth);
        const double e = radians(elevation);
        const double length = 6 * plane.worldPerHeight(relief.space) * std::abs(std::cos(a)) /
                              (plane.worldPerTexel(a) * std::tan(e));
        const double aside = length * std::abs(std::tan(a));
        if (length < 2 || length > 28 || aside > 14) continue;  // on the lee slope, or off the map
        ++shadows;
        // The samples run slightly oblique, off the lines of texel centres.
        surface::SampleGrid samples{2,
                                    1,
                                    {plane.sampleAt({31.5 + length - 0.05, 15.7}),
                                     plane.sampleAt({31.5 + length + 0.05, 15.7})}};
        const Truth truth = traceShadows(surface, relief, mesh, scene, samples,
                                         TraceSettings{{plane.lightOver(a, e)}});
        EXPECT_EQ(truth.mask.samples[0], Shade::shadowed)
            << plane.px.x << " " << plane.py.x << " azimuth " << azimuth << " " << elevation;
        EXPECT_EQ(truth.mask.samples[1], Shade::lit)
            << plane.px.x << " " << plane.py.x << " azimuth " << azimuth << " " << elevation;
      }
    }
  }
  EXPECT_GT(shadows, 15);
}

/// An occluder's reach is measured in texels along the light's azimuth, at the sample's own metric:
/// the wall's top edge lies `length` texels / |e_x| away.
TEST_P(ShearedTruth, RadiusIsInTexelsAlongTheLight) {
  for (const ShearedPlane& plane : shearedPlanes()) {
    if (plane.mirrored()) continue;
    relief::Relief relief =
        stepRelief(plane.width, plane.height, 30, [](int i, int) { return i < 32; });
    relief.space = GetParam();
    const surface::LimitSurface surface(plane.cage());
    const MicroMesh mesh(surface, relief, {0.25, 0});
    const MicroScene scene(mesh);
    const SurfacePaths paths(surface);
    const double a = radians(160);
    const double e = radians(4);
    const surface::SampleGrid samples{1, 1, {plane.sampleAt({42.5, 15.7})}};
    // The ray meets the wall's slope, which rises from 0 at x = 32.5 to 30 a at 31.5.
    const double rise = std::tan(e) * plane.worldPerTexel(a) / std::abs(std::cos(a));  // a texel
    const double steep = 30 * plane.worldPerHeight(relief.space);
    const double met = 10 + rise * 10 / (steep - rise);  // texels along x
    const double reach = met / std::abs(std::cos(a));
    ASSERT_LT(met, 11);
    for (const auto& [radius, region] :
         {std::pair{reach + 0.02, Region::cast}, {reach - 0.02, Region::distant}}) {
      const TraceSettings light{{plane.lightOver(a, e)}};
      Truth truth = traceShadows(surface, relief, mesh, scene, samples, light);
      splitCastShadows(surface, relief, mesh, scene, paths, {radius}, samples, {&light, 1},
                       {&truth, 1});
      EXPECT_EQ(truth.regions[0], region) << plane.px.x << " " << plane.py.x;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(HeightSpaces, ShearedTruth,
                         testing::Values(relief::HeightSpace::world, relief::HeightSpace::texture));

}  // namespace
}  // namespace gnomon::truth
