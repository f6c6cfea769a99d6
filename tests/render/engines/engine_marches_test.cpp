// Marches that engines ship, each against its source's own case or a closed form.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "relief/patterns.h"
#include "render/displaced_rays.h"
#include "render/engines/engine_methods.h"
#include "render/soft/soft_light.h"

namespace gnomon::render {
namespace {

using test::cliff;
using test::difference;
using test::lightToward;
using test::meanDifference;
using test::methodOf;
using test::Parameters;
using test::Profile;
using test::randomRelief;
using test::RenderScene;
using test::shareShadowed;
using test::testOf;
using test::towardLowX;

// ---- parallax-occlusion

TEST(ParallaxOcclusion, OfACliffIsTheHighestOfItsTaps) {
  const GlContext gl;
  const Profile profile(cliff);
  const std::array<double, 7> weights{12, 10, 8, 6, 4, 2, 1};
  const double way = 10 * std::cos(radians(30));
  // So soft that no tap hides all.
  const std::vector<double> shares =
      profile.shares("parallax-occlusion", towardLowX, radians(1), {{"softening", 0.1}});
  int checked = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double x = Profile::place(static_cast<int>(i));
    if (x < 32.5) continue;
    double hidden = 0;
    bool isOnTheWall = false;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const double t = 0.22 + 0.11 * static_cast<double>(k);
      const double tap = x - t * way;
      isOnTheWall = isOnTheWall || (tap > 31.5 && tap < 32.5);
      if (tap <= 31.5) hidden = std::max(hidden, 0.1 * weights[k] * (1 - t));
    }
    if (isOnTheWall) continue;
    ++checked;
    EXPECT_NEAR(shares[i], std::clamp(1 - hidden, 0.0, 1.0), 1e-5) << x;
  }
  EXPECT_GT(checked, 200);
}

/// With many taps and a hard edge a cliff of height H has a shadow of 0.88 H cos θ, not H / tan θ.
TEST(ParallaxOcclusion, EndsAShadowWhereItsLastTapDoes) {
  const GlContext gl;
  const Profile profile(cliff);
  for (const double elevation : {15.0, 30.0, 50.0}) {
    const double end = profile.endOfShadow("parallax-occlusion", lightToward(180, elevation), 32.5,
                                           {{"taps", 500}, {"softening", 1e6}});
    // The wall's foot is at 32.5; a tap over its flank still stands over the ray.
    const double top = 31.5 + 0.88 * 10 * std::cos(radians(elevation));
    EXPECT_GT(end, top - 0.2) << elevation;
    EXPECT_LT(end, top + 0.3) << elevation;
  }
}

// ---- normal-march

/// A ramp of the slope s and the width w: the sum of -N·L gives it 1 / √(1 + s²) of its shadow's
/// length, less a step of the march, since it begins with the point's own.
TEST(NormalMarch, ShortensTheShadowOfARampByTheLengthOfItsNormal) {
  const GlContext gl;
  constexpr int foot = 60;
  constexpr int width = 12;
  for (const double slope : {0.5, 1.0, 2.0}) {
    const Profile profile([&](int i) { return slope * std::clamp(foot - i, 0, width); });
    for (const double elevation : {12.0, 20.0}) {
      const double tangent = std::tan(radians(elevation));
      const double reach = 80;
      const double samples = 800;
      const double length = width * (slope / tangent - 1) / std::sqrt(1 + slope * slope);
      if (length > 30) continue;
      const double end = profile.endOfShadow(
          "normal-march", lightToward(180, elevation), foot + 0.5,
          {{"samples", samples}, {"height_scale", 1}, {"reach", reach / Profile::columns}});
      EXPECT_NEAR(end, foot + 0.5 + length - reach / samples, 0.2) << slope << " " << elevation;
    }
  }
}

/// V = 1 - hardness × height scale × the mean of (1 - place) where the sum is at its highest.
TEST(NormalMarch, ItsShareIsTheMeanOverTheSamplesThatRise) {
  const GlContext gl;
  const auto height = [](int i) { return i < 50 ? 2.0 * (50 - i) : 0.0; };
  const Profile profile(height);
  const double elevation = radians(25);
  const Parameters parameters{
      {"samples", 10}, {"height_scale", 1.5}, {"reach", 0.2}, {"hardness", 0.4}};
  const std::vector<double> shares =
      profile.shares("normal-march", lightToward(180, 25), radians(1), parameters);
  const auto rise = [&](double x) {
    const int below = static_cast<int>(std::floor(x - 0.5));
    const double slope = height(below) - height(below + 1);
    return (slope * std::cos(elevation) - std::sin(elevation)) / std::hypot(1, slope);
  };
  double partly = 0;
  for (int column = 30 * Profile::perTexel; column < 90 * Profile::perTexel; ++column) {
    const double x = Profile::place(column);
    double sum = std::min(rise(x), 0.0);
    double highest = 0;
    double hidden = 0;
    for (int k = 0; k < 10; ++k) {
      const double place = (k + 0.5) * 0.02;  // widths of the map, for a level light
      sum += rise(x - place * 1.5 * std::cos(elevation) * Profile::columns);
      if (sum > highest) hidden += 0.4 * 1.5 * (1 - place);
      highest = std::max(highest, sum);
    }
    const double expected = std::max(1 - hidden / 10, 0.0);
    EXPECT_NEAR(shares[static_cast<std::size_t>(column)], expected, 1e-5) << x;
    partly += expected > 0 && expected < 1 ? 1 : 0;
  }
  EXPECT_GT(partly, 100);
}

// ---- marches over a curved surface

relief::Relief columns() {
  return {relief::makeColumns(64, 64, {32, 6, 2}, 4, relief::Wrap::repeat),
          relief::HeightSpace::world, Vec2(1)};
}

TEST(CurvedRelief, OnAPlaneIsTheReliefMarch) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(64, 64, 8, 8), randomRelief(64, 64, 4, 3), {4, 24},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  for (const Vec3& light : {lightToward(20, 30), lightToward(155, 12), lightToward(200, -5)}) {
    const Mask march = testOf(scene, "relief-march", view, light);
    EXPECT_GT(shareShadowed(march), 0.1);
    EXPECT_LT(difference(testOf(scene, "curved-relief", view, light), march), 1e-3);
  }
}

TEST(BentRayMarch, OnAPlaneIsTheMarchOnTheCircle) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(64, 64, 8, 8), randomRelief(64, 64, 4, 3), {4, 24},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  for (const Vec3& light : {lightToward(20, 30), lightToward(155, 12)}) {
    const Mask march = testOf(scene, "osculating-march", view, light);
    EXPECT_GT(shareShadowed(march), 0.1);
    EXPECT_LT(difference(testOf(scene, "bent-ray-march", view, light), march), 1e-3);
  }
}

/// A sphere has no twist, and its parabola leaves the circle in the fourth order: a quadric is
/// nearly the circle there. The frame that turns is as good.
TEST(CurvedReliefAndBentRays, OnASphereAreNearlyTheMarchOnTheCircle) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(60, 1, 1, 16, 16), columns(), {4, 48},
                          horizon::TableBits::eight, 2);
  const RenderView view = atlasView(scene.surface, 12);
  for (const Vec3& light : {lightToward(20, 10), lightToward(180, 12)}) {
    const Mask circle = testOf(scene, "osculating-march", view, light, {{"stride", 0.05}});
    const double flat = difference(testOf(scene, "relief-march", view, light), circle);
    const double quadric =
        difference(testOf(scene, "curved-relief", view, light, {{"steps", 1000}}), circle);
    const double bent =
        difference(testOf(scene, "bent-ray-march", view, light, {{"stride", 0.05}}), circle);
    EXPECT_GT(flat, 0.05);
    EXPECT_LT(quadric, flat / 4);
    EXPECT_LT(bent, flat / 4);
  }
}

/// A plane whose map lies in rings about a centre: straight rays are bent paths over it.
TEST(BentRayMarch, FollowsThePathOverTheMap) {
  const GlContext gl;
  surface::Cage cage = surface::makePlane(96, 48, 48, 24);
  for (Vec3& position : cage.positions) {
    const double angle = position.x / 60;
    position = (60 + position.y) * Vec3(std::sin(angle), std::cos(angle), 0);
  }
  cage.grid.reset();
  const relief::Relief relief{relief::makeCosine(96, 48, {24}, 6, relief::Wrap::repeat),
                              relief::HeightSpace::world, Vec2(1)};
  const RenderScene scene(cage, relief, {4, 96}, horizon::TableBits::eight, 2);
  const RenderView view = atlasView(scene.surface, 6);
  for (const Vec3& light : {lightToward(160, 20), lightToward(20, 14)}) {
    const Mask path = testOf(scene, "geodesic-march", view, light);
    const double straight = difference(testOf(scene, "osculating-march", view, light), path);
    const double bent = difference(testOf(scene, "bent-ray-march", view, light), path);
    EXPECT_GT(shareShadowed(path), 0.1);
    EXPECT_LT(bent, straight / 3);
    EXPECT_GT(straight, 0.01);
  }
}

/// On a saddle whose axes lie across the texture's, x y alone, the quadric of the texture's axes is
/// flat.
TEST(CurvedRelief, DoesNotKnowTheTwistBetweenTheAxes) {
  const GlContext gl;
  std::array<Vec3, 16> points{};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const Vec2 place = 8.0 * (Vec2(i, j) / 1.5 - 1.0);
      points[static_cast<std::size_t>(4 * j + i)] = Vec3(place, place.x * place.y / 60);
    }
  }
  const relief::Relief relief{relief::makeColumns(16, 16, {8, 2, 1}, 2, relief::Wrap::clamp),
                              relief::HeightSpace::world, Vec2(1)};
  const RenderScene scene(surface::makeBezier(points, 8, 8), relief, {4, 8},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  const Vec3 light = lightToward(45, 20);
  const Mask flat = testOf(scene, "relief-march", view, light);
  EXPECT_LT(difference(testOf(scene, "curved-relief", view, light), flat), 0.01);
  EXPECT_GT(difference(testOf(scene, "osculating-march", view, light), flat), 0.03);
}

// ---- base-shadow-map

TEST(BaseShadowMap, OnAPlaneIsTheReliefMarch) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(64, 64, 8, 8), randomRelief(64, 64, 4, 3), {4, 24},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  for (const Vec3& light : {lightToward(20, 30), lightToward(155, 12), lightToward(290, 3)}) {
    EXPECT_EQ(difference(testOf(scene, "base-shadow-map", view, light),
                         testOf(scene, "relief-march", view, light)),
              0);
    const auto shares = [&](const std::string& name) {
      return scene.shares(methodOf(name), view, light, radians(3)).test;
    };
    EXPECT_EQ(meanDifference(shares("base-shadow-map"), shares("relief-march")), 0);
  }
}

/// A torus without relief: what one side of it throws on the other is the depth map's alone.
TEST(BaseShadowMap, SeesTheBodyItself) {
  const GlContext gl;
  const surface::Cage cage = surface::makeTorus(30, 10, 58, 58);
  const RenderScene scene(cage, test::flatRelief(16, 16), {4, 8}, horizon::TableBits::eight);
  const RenderView view = cameraView(test::cameraAt({90, 90, 20}, {0, 0, 0}, 45, 256), scene.mesh);
  const surface::SampleGrid samples = scene.samples(view);
  const Vec3 light = glm::normalize(Vec3(1, 0.07, 0.3));
  const Mask rays = test::Rays(test::DisplacedScene(cage, test::flatRelief(16, 16), 1), 1)
                        .mask(samples, light, 0.1);
  const auto wrong = [&](const std::string& name) {
    const test::Verdict verdict = test::judge(scene.answer(name, view, light), rays, samples);
    EXPECT_GT(verdict.dark, 300U);
    return static_cast<double>(verdict.wrong) / static_cast<double>(verdict.lit + verdict.dark);
  };
  EXPECT_LT(wrong("base-shadow-map"), 0.02);
  EXPECT_GT(wrong("relief-march"), 0.05);
}

/// A trough of six flat pieces, z = x² / 60. The light sees the first one, of the slope -40 / 60,
/// from behind, and nothing before it: there the march alone says what is seen, by the normal
/// between the vertices, which faces the light from x = -19 on.
TEST(BaseShadowMap, AFacetSeenFromBehindDoesNotShadeItself) {
  const GlContext gl;
  surface::Cage cage = surface::makePlane(48, 8, 6, 1);
  for (Vec3& position : cage.positions) position.z = position.x * position.x / 60;
  cage.grid.reset();
  const RenderScene scene(cage, test::flatRelief(16, 16), {4, 8}, horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 32);
  const surface::SampleGrid samples = scene.samples(view);
  const Vec3 light = lightToward(180, std::atan(38.0 / 60) * 180 / pi);
  const auto shares = [&](const char* method) {
    return scene.shares(methodOf(method), view, light, radians(3)).test.shares;
  };
  const std::vector<float> both = shares("base-shadow-map");
  const std::vector<float> march = shares("relief-march");
  int seen = 0;
  for (std::size_t i = 0; i < both.size(); ++i) {
    if (!samples.samples[i].isOnSurface()) continue;
    const double x = scene.surface.evaluate(samples.samples[i]).position.x;
    if (x < -18.5 || x > -16.2) continue;
    EXPECT_NEAR(both[i], march[i], 1e-3) << x;
    seen += march[i] > 0.5 ? 1 : 0;
  }
  EXPECT_GT(seen, 100);
}

/// A step of the mesh itself, half a unit high and straight in its last piece: what casts its
/// shadow is hardly nearer to the light than the ground.
TEST(BaseShadowMap, SeesALowStep) {
  const GlContext gl;
  surface::Cage cage = surface::makePlane(48, 6, 192, 4);
  for (Vec3& position : cage.positions) position.z = position.x < -0.01 ? 0.5 : 0;
  cage.grid.reset();
  const RenderScene scene(cage, test::flatRelief(16, 16), {4, 8}, horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 4);
  const surface::SampleGrid samples = scene.samples(view);
  const Mask mask = testOf(scene, "base-shadow-map", view, lightToward(180, 15));
  // The top's last vertex, from which on the mesh falls more steeply than the light.
  const double end = -0.5 + 0.5 / std::tan(radians(15));
  int dark = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (!samples.samples[i].isOnSurface()) continue;
    const double x = scene.surface.evaluate(samples.samples[i]).position.x;
    if (x < 0.5 || std::abs(x - end) < 0.2) continue;
    EXPECT_EQ(mask.samples[i], x < end ? Shade::shadowed : Shade::lit) << x;
    dark += x < end ? 1 : 0;
  }
  EXPECT_GT(dark, 50);
}

}  // namespace
}  // namespace gnomon::render
