// What a method of one's own may say of a light's disc: a share, a horizon, or directions one by
// one.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "common/error.h"
#include "render/method_text.h"
#include "render/soft/soft_scenes.h"

namespace gnomon::render {
namespace {

using test::inDegrees;
using test::meanDifference;
using test::methodOf;
using test::methodOfText;
using test::RenderScene;
using test::shareOver;
using test::SoftBumps;
using test::SoftWall;
using test::sun;

/// The march along the path, toward 64 directions over the disc.
Method directionsOneByOne() {
  return methodOfText("tables = [\"height\"]",
                      "float visibility(Pixel pixel, LocalLight light) {\n"
                      "  float lit = 0.0;\n"
                      "  for (int k = 0; k < 64; ++k) {\n"
                      "    vec3 direction = discDirection(k, 64);\n"
                      "    Path path = makePath(pixel, makeLocalLight(pixel, direction));\n"
                      "    bool dark = shadowedByBareSurface(path) || "
                      "shadowedAtCrossings(path, path.limit);\n"
                      "    lit += dark ? 0.0 : 1.0;\n"
                      "  }\n"
                      "  return lit / 64.0;\n}\n");
}

TEST(OwnSoftAnswers, MayAnswerWithAShareAlone) {
  const GlContext gl;
  const SoftWall wall;
  const Method mine =
      methodOfText("",
                   "float visibility(Pixel pixel, LocalLight light) {\n"
                   "  return pixel.texel.x < 48.0 ? 0.25 : shareOver(light.slope, 0.5);\n}\n");
  EXPECT_TRUE(mine.answersShares);
  EXPECT_FALSE(mine.hasHorizon);
  const double elevation = inDegrees(std::atan(0.5)) + 0.5;
  const auto shares =
      wall.scene.shares(mine, wall.view, SoftWall::light(elevation), radians(2.0)).test;
  const Mask mask = wall.scene.test(mine, wall.view, SoftWall::light(elevation));
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const bool isNear = i % SoftWall::columns < 48;
    const double exact = isNear ? 0.25 : shareOver(radians(0.5), radians(2.0));
    ASSERT_NEAR(static_cast<double>(shares.shares[i]), exact, 1e-4);
    // Of a point the cut of equal areas.
    ASSERT_EQ(mask.samples[i], isNear ? Shade::shadowed : Shade::lit);
  }
}

TEST(OwnSoftAnswers, MayAnswerWithBothEnds) {
  const GlContext gl;
  const SoftWall wall;
  const Method mine = methodOfText("",
                                   "float visibility(Pixel pixel, LocalLight light) {\n"
                                   "  int x = int(pixel.texel.x) % 3;\n"
                                   "  return x == 1 ? 1.0 : 0.0;\n}\n");
  const auto found = wall.scene.shares(mine, wall.view, SoftWall::light(20), sun);
  for (std::size_t i = 0; i < found.test.size(); ++i) {
    const bool isWhole = i % SoftWall::columns % 3 == 1;
    ASSERT_EQ(found.test.shares[i], isWhole ? 1.0F : 0.0F);
    ASSERT_LE(found.drawn.shares[i], found.test.shares[i]);
  }
}

TEST(OwnSoftAnswers, MayHaveAHorizonAlone) {
  const GlContext gl;
  const SoftWall wall;
  const Method mine =
      methodOfText("", "float horizonSlope(Pixel pixel, LocalLight light) { return 0.5; }\n");
  EXPECT_FALSE(mine.answersShares);
  EXPECT_TRUE(mine.hasHorizon);
  for (const double over : {-1.0, 0.4, 3.0}) {
    const Vec3 light = SoftWall::light(inDegrees(std::atan(0.5)) + over);
    const auto shares =
        wall.scene.shares(mine, wall.view, light, radians(2.0), SoftAnswer::disc).test;
    ASSERT_NEAR(static_cast<double>(shares.shares[500]), shareOver(radians(over), radians(2.0)),
                1e-4);
    const auto hard = wall.scene.shares(mine, wall.view, light, radians(2.0)).test;
    ASSERT_EQ(hard.shares[500], over > 0 ? 1.0F : 0.0F);
  }
}

TEST(OwnSoftAnswers, WithoutAHorizonHaveNoDisc) {
  const GlContext gl;
  const SoftWall wall;
  try {
    (void)wall.scene.shares(methodOf("unshadowed"), wall.view, SoftWall::light(20), sun,
                            SoftAnswer::disc);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("unshadowed: no function `float horizonSlope("),
              std::string::npos)
        << error.what();
  }
}

TEST(OwnSoftAnswers, DirectionsOverTheDiscAreOfEqualSolidAngle) {
  const GlContext gl;
  const SoftWall wall;
  const Method counting =
      methodOfText("",
                   "float visibility(Pixel pixel, LocalLight light) {\n"
                   "  float over = 0.0;\n"
                   "  for (int k = 0; k < 256; ++k) {\n"
                   "    vec3 to = discDirection(k, 256);\n"
                   "    over += to.z > 0.35 && abs(length(to) - 1.0) < 1e-5 ? 1.0 : 0.0;\n"
                   "  }\n"
                   "  return over / 256.0;\n}\n");
  const double edge = inDegrees(std::asin(0.35));
  for (const double radius : {0.5, 5.0}) {
    for (const double x : {-0.9, -0.5, 0.0, 0.3, 0.8}) {
      const auto found =
          wall.scene
              .shares(counting, wall.view, SoftWall::light(edge + x * radius), radians(radius))
              .test;
      EXPECT_NEAR(static_cast<double>(found.shares[100]), shareOver(x, 1), 0.01) << x;
    }
  }
}

/// Over a wall across the light the one horizon of the march is that of all directions; over bumps
/// it is not, and the bounds are what was found.
TEST(OwnSoftAnswers, OneHorizonIsNearToDirectionsOneByOne) {
  const GlContext gl;
  const Method each = directionsOneByOne();
  const SoftWall wall;
  const auto difference = [&](const RenderScene& scene, const RenderView& view, const Vec3& light,
                              double radius, const std::string& name) {
    return meanDifference(scene.shares(methodOf(name), view, light, radius).test,
                          scene.shares(each, view, light, radius).test);
  };
  EXPECT_LT(difference(wall.scene, wall.view, SoftWall::light(18), radians(3.0), "geodesic-march"),
            0.002);
  const SoftBumps bumps;
  EXPECT_LT(difference(bumps.scene, bumps.view, bumps.light, sun, "geodesic-march"), 0.0005);
  // One march in place of two would have twice that.
  EXPECT_LT(difference(bumps.scene, bumps.view, bumps.light, radians(3.0), "geodesic-march"),
            0.0025);
}

}  // namespace
}  // namespace gnomon::render
