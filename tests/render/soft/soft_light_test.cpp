#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "render/method_text.h"
#include "render/render_scene.h"
#include "render/soft/soft_scenes.h"
#include "render/traced_scene.h"
#include "truth/truth_scenes.h"

// The share of a light's disc that methods answer with: against closed forms, and against the masks
// of a light without a radius.
// What a method of one's own may say of a light's disc: a share, a horizon, or directions one by
// one.

namespace gnomon::render {
namespace {

using test::DisplacedScene;
using test::inDegrees;
using test::lightToward;
using test::meanDifference;
using test::methodOf;
using test::methodOfText;
using test::RenderScene;
using test::shareOver;
using test::softAnswerOf;
using test::SoftBumps;
using test::SoftWall;
using test::sun;
using test::TracedScene;

TEST(SoftLight, OverAWallIsTheClosedForm) {
  const GlContext gl;
  const SoftWall wall;
  for (const double radius : {sun, radians(1.0), radians(5.0)}) {
    for (const char* name : {"max-forsyth", "onoue-2003", "onoue-2004", "onoue-exact",
                             "geodesic-march", "resampled-horizon", "osculating-march"}) {
      EXPECT_LT(wall.errorOf(name, radius), 0.002) << name << " " << radius;
    }
    // It knows where the plane ends, and the wall with it: half of a disc of 5° is seen past it
    // from farther in than 3 rows.
    EXPECT_LT(wall.errorOf("surface-march", radius, {}, 6), 0.002) << radius;
  }
  // Its steps may miss the wall's edge by one of them.
  EXPECT_LT(wall.errorOf("relief-march", radians(5.0), {{"steps", 1024}}), 0.01);
  // Its lookup textures give the horizon's angle to 4e-4.
  EXPECT_LT(wall.errorOf("sloan-cohen", radians(5.0)), 0.01);
  const VisibilityAnswers hard =
      wall.scene.shares(methodOf("max-forsyth"), wall.view, SoftWall::light(17.3), radians(5.0));
  EXPECT_GT(wall.error(hard.test, 17.3, radians(5.0)), 0.4) << "0 or 1 is not a share";
}

/// V where the horizon's angle is wrong by `angle`: dV / dx is 2 / π at most.
double shareOff(double angle, double radius) {
  return 2 / pi * angle / radius;
}

/// Its rays end within 0.001 radians of the horizon, and its basis maps mix in some of the azimuths
/// beside the light's, where the wall has ended.
TEST(SoftLight, OfHorizonsShotOnTheSurfaceIsTheClosedForm) {
  const GlContext gl;
  SoftWall wall;
  const TracedScene traced(wall.scene.surface, wall.scene.relief, 0.25);
  wall.scene.surfaceAngles = shot(wall.scene, traced, 8, pi / 2);
  for (const double radius : {radians(2.0), radians(5.0)}) {
    EXPECT_LT(wall.errorOf("sloan-cohen-surface", radius), shareOff(0.004, radius)) << radius;
  }
  const VisibilityAnswers hard = wall.scene.shares(methodOf("sloan-cohen-surface"), wall.view,
                                                   SoftWall::light(17.3), radians(5.0));
  EXPECT_GT(wall.error(hard.test, 17.3, radians(5.0)), 0.4) << "0 or 1 is not a share";
}

/// Its table ends at the tangent plane, which is a sphere's own horizon. A facet of an eighth of a
/// texel leans from it by up to 0.0018 radians.
TEST(SoftLight, OfHorizonsShotOnASphereKnowsTheTerminator) {
  const GlContext gl;
  RenderScene scene(surface::makeSphere(60, 1.8, 0.8, 30, 15),
                    test::stepRelief(
                        64, 32, 3, [](int, int) { return true; }, relief::Wrap::repeat),
                    {8, 64}, horizon::TableBits::thirtyTwo, 8);
  const TracedScene traced(scene.surface, scene.relief, 0.125);
  scene.surfaceAngles = shot(scene, traced, 8, pi / 2);
  const RenderView view = atlasView(scene.surface, 8);
  const surface::SampleGrid samples = scene.samples(view);
  const Vec3 light = lightToward(0, 2);
  const double disc = radians(5.0);
  const Visibility found =
      scene.shares(methodOf("sloan-cohen-surface"), view, light, disc, SoftAnswer::disc).test;
  std::size_t inPenumbra = 0;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const surface::LimitPoint place = scene.surface.evaluate(samples.samples[i]);
    const Vec3 normal = glm::normalize(glm::cross(place.ds, place.dt));
    const double seen = shareOver(std::asin(glm::dot(normal, light)), disc);
    ASSERT_NEAR(static_cast<double>(found.shares[i]), seen, shareOff(0.005, disc)) << i;
    inPenumbra += seen > 0 && seen < 1 ? 1 : 0;
  }
  EXPECT_GT(inPenumbra, 100U);
}

/// Ground as high everywhere is a larger sphere with the same terminator. Marches leave it to the
/// shading normal: between themselves and the first crossing they see no slope.
TEST(SoftLight, AtASpheresTerminatorIsTheClosedForm) {
  const GlContext gl;
  constexpr double radius = 60;
  const Vec3 light = lightToward(0, 2);
  for (const double height : {0.0, 3.0}) {
    const RenderScene scene(
        surface::makeSphere(radius, 1.8, 0.8, 30, 15),
        test::stepRelief(
            64, 32, height, [](int, int) { return true; }, relief::Wrap::repeat),
        {8, 64}, horizon::TableBits::thirtyTwo, 8);
    const RenderView view = atlasView(scene.surface, 8);
    const surface::SampleGrid samples = scene.samples(view);
    for (const double disc : {radians(1.0), radians(5.0)}) {
      for (const char* name : {"onoue-2003", "onoue-2004", "onoue-exact", "geodesic-march",
                               "resampled-horizon", "osculating-march", "surface-march"}) {
        const Method method = methodOf(name);
        const VisibilityAnswers found =
            scene.shares(method, view, light, disc, softAnswerOf(method));
        double test = 0;
        double drawn = 0;
        std::size_t inPenumbra = 0;
        for (std::size_t i = 0; i < samples.samples.size(); ++i) {
          const surface::LimitPoint place = scene.surface.evaluate(samples.samples[i]);
          const Vec3 normal = glm::normalize(glm::cross(place.ds, place.dt));
          const double elevation = std::asin(glm::dot(normal, light));
          const double seen = shareOver(elevation, disc);
          test = std::max(test, std::abs(seen - static_cast<double>(found.test.shares[i])));
          drawn = std::max(drawn, std::abs(seen - static_cast<double>(found.drawn.shares[i])));
          inPenumbra += seen > 0 && seen < 1 ? 1 : 0;
        }
        EXPECT_GT(inPenumbra, 100U) << name;
        const bool leavesItToTheNormal = height > 0 || method.name == "surface-march";
        if (!leavesItToTheNormal || method.hasHorizon) {
          EXPECT_LT(test, 0.002) << name << " " << height << " " << disc;
        }
        EXPECT_LT(drawn, 0.002) << name << " " << height << " " << disc;
      }
    }
  }
}

std::vector<std::string> methodsOfTheBaseMesh() {
  std::vector<std::string> names;
  for (const std::string& name : methodNames(shaderFolder())) {
    const Method method = methodOf(name);
    // Angles of the surface itself need a truth.
    if (method.mesh == DrawnMesh::base && !method.tables.surfaceAngles) names.push_back(name);
  }
  return names;
}

/// Those of them that answer with shares, by themselves or by a horizon.
std::vector<std::string> softMethods() {
  std::vector<std::string> names = methodsOfTheBaseMesh();
  std::erase_if(names, [](const std::string& name) {
    const Method method = methodOf(name);
    return !method.answersShares && !method.hasHorizon;
  });
  return names;
}

void expectShares(const Visibility& found, const Mask& mask, const std::string& name) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool isSample = mask.samples[i] != Shade::none;
    ASSERT_EQ(isSample, !std::isnan(found.shares[i])) << name;
    if (!isSample) continue;
    ASSERT_TRUE(found.shares[i] >= 0 && found.shares[i] <= 1) << name << " " << found.shares[i];
  }
}

void expectMask(const Visibility& found, const Mask& mask, const std::string& name) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (mask.samples[i] == Shade::none) {
      ASSERT_TRUE(std::isnan(found.shares[i])) << name;
    } else {
      ASSERT_EQ(found.shares[i], mask.samples[i] == Shade::lit ? 1.0F : 0.0F) << name;
    }
  }
}

TEST(SoftLight, WithoutARadiusIsTheMask) {
  const GlContext gl;
  const SoftBumps bumps;
  for (const std::string& name : methodsOfTheBaseMesh()) {
    const Method method = methodOf(name);
    const MethodAnswers hard = bumps.scene.answers(method, bumps.view, {bumps.light}).front();
    for (const SoftAnswer soft : {SoftAnswer::own, SoftAnswer::disc}) {
      if (soft == SoftAnswer::disc && !method.hasHorizon) continue;
      const VisibilityAnswers found = bumps.scene.shares(method, bumps.view, bumps.light, 0, soft);
      expectMask(found.drawn, hard.drawn, name);
      expectMask(found.test, hard.test, name);
    }
  }
}

TEST(SoftLight, OfAHardMethodIsTheMask) {
  const GlContext gl;
  const SoftBumps bumps;
  for (const char* name : {"unshadowed", "max-forsyth"}) {
    const Method method = methodOf(name);
    const MethodAnswers hard = bumps.scene.answers(method, bumps.view, {bumps.light}).front();
    const VisibilityAnswers found = bumps.scene.shares(method, bumps.view, bumps.light, radians(5));
    expectMask(found.drawn, hard.drawn, name);
    expectMask(found.test, hard.test, name);
  }
}

TEST(SoftLight, IsAShareOfEverySample) {
  const GlContext gl;
  const SoftBumps bumps;
  for (const std::string& name : softMethods()) {
    const Method method = methodOf(name);
    const Mask mask = bumps.scene.test(method, bumps.view, bumps.light);
    for (const double degrees : {0.01, 0.266, 10.0}) {
      const VisibilityAnswers found = bumps.scene.shares(method, bumps.view, bumps.light,
                                                         radians(degrees), softAnswerOf(method));
      expectShares(found.test, mask, name);
      expectShares(found.drawn, mask, name);
    }
  }
}

/// Methods whose share is soft by itself, whatever the light's size.
const std::set<std::string> softByThemselves = {"ao-micro-shadow", "ao-shadow", "normal-march",
                                                "parallax-occlusion"};

/// A disc as small as a point: the shares are the mask's but on the shadows' edges.
TEST(SoftLight, TendsToTheMask) {
  const GlContext gl;
  const SoftBumps bumps;
  for (const std::string& name : softMethods()) {
    const Method method = methodOf(name);
    if (softByThemselves.contains(name)) continue;
    const VisibilityAnswers hard = bumps.scene.shares(method, bumps.view, bumps.light, 0);
    const VisibilityAnswers found =
        bumps.scene.shares(method, bumps.view, bumps.light, radians(0.001), softAnswerOf(method));
    EXPECT_LT(meanDifference(found.test, hard.test), 0.003) << name;
    EXPECT_LT(meanDifference(found.drawn, hard.drawn), 0.003) << name;
  }
}

TEST(SoftLight, DoesNotChangeSharesThatAreSoftByThemselves) {
  const GlContext gl;
  const SoftBumps bumps;
  for (const std::string& name : softByThemselves) {
    const Method method = methodOf(name);
    const VisibilityAnswers small =
        bumps.scene.shares(method, bumps.view, bumps.light, radians(0.001));
    const VisibilityAnswers large = bumps.scene.shares(method, bumps.view, bumps.light, radians(5));
    const auto isPart = [](float share) { return share > 0.01F && share < 0.99F; };
    EXPECT_TRUE(std::any_of(small.test.shares.begin(), small.test.shares.end(), isPart)) << name;
    EXPECT_EQ(meanDifference(small.test, large.test), 0) << name;
  }
}

/// Mean error behind a wall of height 10, whose displaced mesh of one piece a texel has its edge at
/// x = 15, of methods that see a depth map.
template <typename Answer>
double meanErrorOfDepth(const Answer& answer, double edge, double radius) {
  double sum = 0;
  double all = 0;
  for (const double elevation : {14.0, 17.3, 22.0, 31.6}) {
    const Visibility found = answer(SoftWall::light(elevation));
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto x = static_cast<double>(i % SoftWall::columns) + 0.5;
      const double over = radians(elevation) - std::atan(10 / (x - edge));
      if (x < 18 || std::abs(over) > 1.5 * radius) continue;
      sum += std::abs(static_cast<double>(found.shares[i]) - shareOver(over, radius));
      all += 1;
    }
  }
  return sum / all;
}

/// In and beside the penumbra. The filter's samples are as many steps of V; the mean depth of
/// blockers is not the edge's.
TEST(SoftLight, OfAShadowMapIsNearTheClosedForm) {
  const GlContext gl;
  const DisplacedScene scene(
      surface::makePlane(SoftWall::columns, SoftWall::rows, 12, 2),
      test::stepRelief(SoftWall::columns, SoftWall::rows, 10, [](int i, int) { return i < 16; }),
      8);
  const RenderView view = atlasView(scene.surface, 8);
  for (const double radius : {radians(1.0), radians(4.0)}) {
    const auto error = [&](const std::map<std::string, double>& parameters) {
      return meanErrorOfDepth(
          [&](const Vec3& light) {
            return scene.shares("shadow-map", view, light, radius, parameters).drawn;
          },
          15, radius);
    };
    EXPECT_LT(error({{"depth_side", 4096}}), 0.05) << radius;
    EXPECT_LT(error({{"depth_side", 4096}, {"search_samples", 256}, {"filter_samples", 256}}), 0.05)
        << radius;
    const double hard = meanErrorOfDepth(
        [&](const Vec3& light) { return scene.shares("shadow-map", view, light, 0).drawn; }, 15,
        radius);
    EXPECT_GT(hard, 0.12) << radius;
  }
}

/// Where the march reaches the wall, and where it ends after four texels and the depth map answers.
TEST(SoftLight, OfTwoScalesIsNearTheClosedForm) {
  const GlContext gl;
  for (const auto& [name, reach] :
       {std::pair{"two-scales", 96.0}, {"two-scales", 4.0}, {"two-scales-surface", 4.0}}) {
    const Method method = methodOf(name);
    const SoftWall wall(reach);
    for (const double radius : {sun, radians(1.0), radians(4.0)}) {
      const double error = meanErrorOfDepth(
          [&](const Vec3& light) {
            return wall.scene
                .shares(method, wall.view, light, radius, SoftAnswer::own,
                        {{"light_pieces", 16}, {"depth_side", 4096}})
                .drawn;
          },
          15.5, radius);
      EXPECT_LT(error, reach > 4 ? 0.02 : 0.045) << name << " " << reach << " " << radius;
    }
  }
}

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
