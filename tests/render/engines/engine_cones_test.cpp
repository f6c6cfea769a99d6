// Marches along cones over the texels: Dummer's, which hold no relief, and the relaxed ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "relief/patterns.h"
#include "render/engines/engine_methods.h"

namespace gnomon::render {
namespace {

using test::cliff;
using test::difference;
using test::lightToward;
using test::methodOf;
using test::Profile;
using test::RenderScene;
using test::shareShadowed;
using test::testOf;

/// Waves on a plane of 64 × 64 texels.
struct Waves {
  static relief::Relief relief() {
    return {relief::makeCosine(64, 64, {16}, 10, relief::Wrap::repeat), relief::HeightSpace::world,
            Vec2(1)};
  }
  RenderScene scene{
      surface::makePlane(64, 64, 8, 8), relief(), {64, 64}, horizon::TableBits::eight};
  RenderView view = atlasView(scene.surface, 16);
};

TEST(ConeSteps, OnAPlaneAreTheReliefMarch) {
  const GlContext gl;
  const Waves waves;
  for (const Vec3& light : {lightToward(20, 25), lightToward(155, 15)}) {
    const Mask march = testOf(waves.scene, "relief-march", waves.view, light, {{"steps", 500}});
    EXPECT_GT(shareShadowed(march), 0.05);
    EXPECT_LT(
        difference(testOf(waves.scene, "cone-steps", waves.view, light, {{"steps", 500}}), march),
        0.02);
    // Fewer steps end before the point: what they call dark may be lit, and nothing is lost.
    const Mask few = testOf(waves.scene, "cone-steps", waves.view, light, {{"steps", 8}});
    EXPECT_GT(shareShadowed(few), shareShadowed(march));
  }
}

// ---- relaxed-cones

/// The baked cones of a method, texels per height unit, as widths of a map of `longest` texels and
/// heights of `range`.
std::vector<double> conesOf(const RenderScene& scene, const char* method, double longest,
                            double range) {
  const StoredBake bake = scene.storedBakes(methodOf(method), {}).front();
  std::vector<double> cones(bake.entry(1));
  for (std::size_t i = 0; i < cones.size(); ++i) {
    cones[i] = bake.values.value(i) * longest / range;
  }
  return cones;
}

/// Before a wall of height H, whose top begins at the distance d and is w wide, a ray may enter the
/// wall and leaves it behind its top: c = (d + w) / H, where a cone without relief has d / H. On
/// the wall itself nothing is higher.
TEST(RelaxedCones, BeforeAWallReachToItsFarSide) {
  const GlContext gl;
  constexpr double height = 10;
  const Profile profile([](int i) { return i >= 40 && i < 44 ? height : 0; });
  const auto cones = conesOf(profile.scene, "relaxed-cones", Profile::columns, height);
  const double code = Profile::columns / height / 255;
  for (const int texel : {5, 20, 38, 46, 70, 90}) {
    const double x = texel + 0.5;
    const double farSide = x < 42 ? 43.5 - x : x - 40.5;
    EXPECT_NEAR(cones[Profile::columns + static_cast<std::size_t>(texel)],
                std::min(farSide / height, Profile::columns / height), 0.51 * code)
        << texel;
  }
  EXPECT_NEAR(cones[Profile::columns + 42], Profile::columns / height, 1e-6);
}

/// The relief under a ray that goes down from the relief's top over a place.
struct RayDown {
  const relief::HeightField& field;
  Vec2 place;   // texels
  Vec2 toward;  // unit
  double fall;  // height units per texel

  /// Whether the ray has left the relief before it leaves a cone over the texel under its
  /// beginning.
  [[nodiscard]] bool leavesWithin(double cone) const {
    const double foot = field.at(place);
    const double top = field.maximum();
    bool wasInside = false;
    for (double r = 0.02; top - fall * r - foot > r / cone; r += 0.02) {
      const bool isInside = field.at(place + r * toward) > top - fall * r;
      if (wasInside && !isInside) return true;
      wasInside = isInside;
    }
    return false;
  }
};

/// By the definition: no ray from above pierces the relief, leaves it and goes on within the cone,
/// and within a cone a fifth wider one does.
TEST(RelaxedCones, AreTheWidestThatRaysPierceOnce) {
  const GlContext gl;
  constexpr double range = 10;
  const Waves waves;
  const relief::HeightField& field = waves.scene.relief.field;
  const auto cones = conesOf(waves.scene, "relaxed-cones", 64, range);
  const auto piercedTwice = [&](Vec2 texel, double cone) {
    for (int m = 0; m < 90; ++m) {
      const double azimuth = 2 * pi * m / 90;
      const Vec2 toward(std::cos(azimuth), std::sin(azimuth));
      for (double fall = 0.01; fall < 1.5; fall *= 1.02) {
        if (RayDown{field, texel + 0.5, toward, fall}.leavesWithin(cone)) return true;
      }
    }
    return false;
  };
  int bounded = 0;
  for (const Vec2& texel : {Vec2(16, 16), Vec2(20, 17), Vec2(22, 22), Vec2(24, 18), Vec2(33, 30)}) {
    const double cone = cones[static_cast<std::size_t>(64 * texel.y + texel.x)];
    EXPECT_FALSE(piercedTwice(texel, 0.95 * cone)) << texel.x << " " << texel.y;
    if (cone > 0.99 * 64 / range) continue;
    ++bounded;
    EXPECT_TRUE(piercedTwice(texel, 1.2 * cone)) << texel.x << " " << texel.y;
  }
  EXPECT_GT(bounded, 3);
}

/// Where steps run out before the ray has entered the relief it is dark, so that fewer steps only
/// darken. The allowance leaves a band of light behind every crest.
TEST(RelaxedCones, OnAPlaneAreTheReliefMarch) {
  const GlContext gl;
  const Waves waves;
  for (const Vec3& light : {lightToward(20, 25), lightToward(155, 15)}) {
    const auto relaxed = [&](double steps, double allowance) {
      return testOf(waves.scene, "relaxed-cones", waves.view, light,
                    {{"steps", steps}, {"allowance", allowance}, {"halvings", 12}});
    };
    const Mask march = testOf(waves.scene, "relief-march", waves.view, light, {{"steps", 500}});
    const Mask exact = relaxed(100, 0.004);
    EXPECT_LT(difference(exact, march), 0.005);
    EXPECT_GT(shareShadowed(relaxed(15, 0.004)), shareShadowed(exact) + 0.02);
    EXPECT_LT(shareShadowed(relaxed(100, 0.05)), shareShadowed(exact) - 0.02);
  }
}

/// A cliff's shadow ends where the light says; what is lower than the allowance has none.
TEST(RelaxedCones, MeetWhatStandsOverTheAllowance) {
  const GlContext gl;
  const Profile edge(cliff);
  for (const double elevation : {15.0, 30.0, 50.0}) {
    const double end = edge.endOfShadow("relaxed-cones", lightToward(180, elevation), 32.5);
    EXPECT_NEAR(end, 31.5 + 10 / std::tan(radians(elevation)), 0.3) << elevation;
  }
  const Profile sill([](int i) { return i < 4 ? 10.0 : (i >= 40 && i < 48 ? 0.4 : 0.0); });
  const Vec3 light = lightToward(180, 30);
  EXPECT_EQ(sill.endOfShadow("relaxed-cones", light, 48.5), 48.5);
  EXPECT_NEAR(
      sill.endOfShadow("relaxed-cones", light, 48.5, {{"allowance", 0.01}, {"halvings", 12}}),
      47.5 + 0.4 / std::tan(radians(30)), 0.5);
}

}  // namespace
}  // namespace gnomon::render
