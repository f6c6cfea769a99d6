#include "truth/sample_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "surface/texel_frame.h"
#include "truth/truth_scenes.h"

namespace gnomon::truth {
namespace {

using test::randomRelief;
using test::sampleAt;

TEST(SamplePlace, OnARampIsThePlanesPointAndTheRampsFacet) {
  const surface::LimitSurface surface(surface::makePlane(16, 8, 4, 2));
  // Heights rise by 1/2 a texel from x = 4.5 to 11.5.
  std::vector<float> texels;
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 16; ++i) texels.push_back(0.5F * static_cast<float>(i));
  }
  const relief::Relief relief{relief::HeightField(16, 8, texels, relief::Wrap::clamp),
                              relief::HeightSpace::world, Vec2(1)};
  const MicroMesh mesh(surface, relief, {0.25, 0});
  const SamplePlace place = SamplePlacer(surface, relief.texelsPerUv(), mesh)
                                .place(sampleAt(surface, relief, {7.3, 2.2}));
  ASSERT_TRUE(place.defined);
  EXPECT_NEAR(glm::distance(place.frame.position, Vec3(7.3 - 8, 2.2 - 4, 0)), 0, 1e-6);
  EXPECT_NEAR(glm::distance(place.frame.normal, Vec3(0, 0, 1)), 0, 1e-12);
  EXPECT_NEAR(glm::distance(place.frame.texel, Vec2(7.3, 2.2)), 0, 1e-6);
  EXPECT_NEAR(
      glm::distance(place.facet.point + mesh.centre(), Vec3(7.3 - 8, 2.2 - 4, 0.5 * (7.3 - 0.5))),
      0, 1e-5);
  EXPECT_NEAR(glm::distance(place.facet.normal, glm::normalize(Vec3(-0.5, 0, 1))), 0, 1e-5);
}

TEST(SamplePlace, PointsConvergeToTheDisplacedSurface) {
  const surface::LimitSurface surface(surface::makeSphere(40, 1, 1, 12, 12));
  const relief::Relief relief = randomRelief(24, 24, 1, 5);
  const surface::SurfaceSample sample{77, 0.31F, 0.64F};
  const Vec3 exact = relief::displaced(
      relief, surface::texelFrame(surface.evaluate(sample), relief.texelsPerUv()));
  double before = 1;
  for (const double step : {0.25, 0.0625}) {
    const MicroMesh mesh(surface, relief, {step, 0});
    const SamplePlace place = SamplePlacer(surface, relief.texelsPerUv(), mesh).place(sample);
    const double off = glm::distance(place.facet.point + mesh.centre(), exact);
    EXPECT_LT(off, before / 4);
    before = off;
  }
}

/// On a plane whose texels are 2 long along x and 3 along y.
TEST(RayLength, IsThatOfItsTraceOverTheCosine) {
  const Vec3 up(0, 0, 1);
  const TexelAxes axes{Vec3(2, 0, 0), Vec3(0, 3, 0)};
  for (const double elevation : {5.0, 45.0, 80.0}) {
    const double cosine = std::cos(radians(elevation));
    EXPECT_NEAR(rayLength(up, axes, test::lightToward(0, elevation), 10), 20 / cosine, 1e-9);
    EXPECT_NEAR(rayLength(up, axes, test::lightToward(90, elevation), 10), 30 / cosine, 1e-9);
  }
  EXPECT_EQ(rayLength(up, axes, up, 10), std::numeric_limits<double>::infinity());
}

TEST(SamplePlace, IsUndefinedWithoutASample) {
  const surface::LimitSurface surface(surface::makePlane(16, 8, 4, 2));
  const relief::Relief relief = test::flatRelief(4, 4);
  const MicroMesh mesh(surface, relief, {0.5, 0});
  const SamplePlace place = SamplePlacer(surface, relief.texelsPerUv(), mesh).place({-1, 0, 0});
  EXPECT_FALSE(place.defined);
  EXPECT_EQ(place.facet.point + mesh.centre(), Vec3(0));
}

}  // namespace
}  // namespace gnomon::truth
