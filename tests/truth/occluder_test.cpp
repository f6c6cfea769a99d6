#include "truth/occluder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "truth/micro_surface.h"
#include "truth/truth_scenes.h"

namespace gnomon::truth {
namespace {

using test::lightToward;
using test::randomRelief;
using test::sampleAt;
using test::samplesOfAllFaces;

/// A surface with its relief, ready to be traced.
struct OccluderScene : test::MicroSurface {
  OccluderScene(const surface::Cage& cage, relief::Relief heights)
      : MicroSurface(cage, std::move(heights), 0.25) {}

  [[nodiscard]] std::optional<Occluder> first(const surface::SurfaceSample& sample,
                                              const Vec3& light) const {
    return firstOccluder(surface, relief, mesh, scene, {sample, light, standardRayOffset});
  }
};

/// The lee face of a wall 6 high falls from x = 31.5 to 32.5, on a plane of one unit a texel whose
/// middle is the origin: the ray from (60, 16) meets it where it is as high.
TEST(FirstOccluder, OfAWallIsTheFaceThatTheRayMeets) {
  const OccluderScene on(test::wallPlane(), test::wallRelief());
  const surface::SurfaceSample sample = sampleAt(on.surface, on.relief, {60, 16});
  const double slope = std::tan(radians(10));
  const auto occluder = on.first(sample, lightToward(180, 10));
  ASSERT_TRUE(occluder);
  EXPECT_FALSE(occluder->attached);
  // Height 6 (32.5 - x) on the face, slope (60 - x) on the ray.
  const double x = (6 * 32.5 - slope * 60) / (6 - slope);
  EXPECT_NEAR(occluder->point.x, x - 48, 1e-3);
  EXPECT_NEAR(occluder->point.y, 0, 1e-3);
  EXPECT_NEAR(occluder->point.z, slope * (60 - x), 1e-3);
  EXPECT_NEAR(occluder->distance, (60 - x) / std::cos(radians(10)), 1e-3);
  EXPECT_FALSE(on.first(sample, lightToward(180, 20)));
  EXPECT_FALSE(on.first(sample, lightToward(0, 5)));
  // The lee face itself is turned from the light.
  const auto lee = on.first(sampleAt(on.surface, on.relief, {32, 16}), lightToward(180, 30));
  ASSERT_TRUE(lee);
  EXPECT_TRUE(lee->attached);
  EXPECT_EQ(lee->distance, 0);
  EXPECT_NEAR(lee->point.z, 3, 1e-2);
}

TEST(FirstOccluder, IsThereExactlyWhereTheTruthIsDark) {
  const OccluderScene on(surface::makeSphere(60, 1, 1, 16, 16), randomRelief(64, 64, 4, 3));
  const surface::SampleGrid samples = samplesOfAllFaces(on.surface, 3);
  for (const double elevation : {60.0, 20.0}) {
    const Vec3 light = lightToward(35, elevation);
    const Truth truth =
        traceShadows(on.surface, on.relief, on.mesh, on.scene, samples, TraceSettings{{light}});
    std::size_t dark = 0;
    for (std::size_t i = 0; i < samples.samples.size(); ++i) {
      const auto occluder = on.first(samples.samples[i], light);
      ASSERT_EQ(occluder.has_value(), truth.mask.samples[i] == Shade::shadowed) << i;
      dark += occluder ? 1U : 0U;
      if (!occluder || occluder->attached) continue;
      EXPECT_GT(occluder->distance, 0);
      // On the displaced surface: within its shell.
      const double height = glm::length(occluder->point) - 60;
      EXPECT_GT(height, -0.1);
      EXPECT_LT(height, 4.1);
    }
    EXPECT_GT(dark, samples.samples.size() / 10);
    EXPECT_LT(dark, samples.samples.size());
  }
}

TEST(FirstOccluder, IsAbsentWithoutASample) {
  const OccluderScene on(surface::makePlane(32, 32, 4, 4), randomRelief(32, 32, 4, 3));
  EXPECT_FALSE(on.first({}, lightToward(35, 20)));
}

}  // namespace
}  // namespace gnomon::truth
