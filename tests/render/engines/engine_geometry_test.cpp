#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "relief/patterns.h"
#include "render/displaced_rays.h"
#include "render/engines/engine_methods.h"

// Methods of engines that draw the displaced mesh, each against a closed form.
// Marches along cones over the texels: Dummer's, which hold no relief, and the relaxed ones.

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

// ---- methods that draw the displaced mesh

/// A plane of 48 × 48 texels whose height is 10 up to x = 19.5, as real geometry.
struct DisplacedCliff {
  static constexpr int side = 48;
  test::DisplacedScene scene{surface::makePlane(side, side, 12, 12),
                             test::stepRelief(side, side, 10, [](int i, int) { return i < 20; }),
                             8};

  /// x of the middle row of a view, texels.
  [[nodiscard]] std::vector<double> places(const RenderView& view) const {
    const surface::SampleGrid samples = scene.samples(view);
    std::vector<double> found;
    for (int i = 0; i < view.width; ++i) {
      const auto& sample =
          samples.samples[static_cast<std::size_t>(view.height / 2 * view.width + i)];
      found.push_back(sample.isOnSurface() ? scene.surface.evaluate(sample).position.x + side / 2.0
                                           : -1);
    }
    return found;
  }
};

/// Two flat depths under the filter: the bound of Chebyshev is the share of the farther, so that V
/// rises evenly over the filter's width.
TEST(VarianceShadowMap, OfTwoDepthsIsTheShareOfTheFarther) {
  const GlContext gl;
  const DisplacedCliff cliff;
  const RenderView view = atlasView(cliff.scene.surface, 64);
  const std::vector<double> places = cliff.places(view);
  const int width = 33;
  const double texel = 2 * boundingSphere(cliff.scene.displaced.mesh).radius / 2048;
  for (const double elevation : {35.0, 50.0}) {
    const Visibility shares = cliff.scene
                                  .shares("variance-shadow-map", view, lightToward(180, elevation),
                                          0.01, {{"width", width}})
                                  .test;
    const double end = 19.5 + 10 / std::tan(radians(elevation));
    int partly = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i] < 22) continue;
      const double across = (places[i] - end) * std::sin(radians(elevation));
      const double expected = std::clamp(0.5 + across / (width * texel), 0.0, 1.0);
      const float found = shares.shares[static_cast<std::size_t>(view.height / 2 * view.width) + i];
      EXPECT_NEAR(found, expected, 0.05) << places[i];
      partly += expected > 0.1 && expected < 0.9 ? 1 : 0;
    }
    EXPECT_GT(partly, 10);
  }
}

/// A light aslant to the cliff, whose edge is aslant in the light's map too: V is the share of the
/// filter's square on the lit side of the edge, texel by texel.
TEST(VarianceShadowMap, FiltersOverASquare) {
  const GlContext gl;
  const DisplacedCliff cliff;
  const RenderView view = atlasView(cliff.scene.surface, 64);
  const std::vector<double> places = cliff.places(view);
  const int width = 33;
  const Vec3 light = lightToward(120, 50);
  const RenderView map = lightView(boundingSphere(cliff.scene.displaced.mesh), light, 2048);
  const auto texelOf = [&](const Vec3& world) {
    const glm::vec4 clip = map.clipFromWorld * glm::vec4(world, 1);
    return Vec2((clip.x + 1) * 1024, (clip.y + 1) * 1024);
  };
  // x of the plane's middle is 24 texels; its rows beyond the sides do not matter in the middle.
  const Vec2 edge = texelOf({19.5 - 24, 0, 10});
  const Vec2 along = texelOf({19.5 - 24, 1, 10}) - edge;
  const auto side = [&](const Vec2& at) {
    return along.x * (at.y - edge.y) - along.y * (at.x - edge.x);
  };
  EXPECT_GT(std::abs(along.x / along.y), 0.5);
  EXPECT_LT(std::abs(along.x / along.y), 2);
  const double litSide = side(texelOf({20, 0, 0}));
  const surface::SampleGrid samples = cliff.scene.samples(view);
  const auto found =
      cliff.scene.shares("variance-shadow-map", view, light, 0.01, {{"width", width}});
  int partly = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] < 22) continue;
    const surface::SurfaceSample& sample =
        samples.samples[static_cast<std::size_t>(view.height / 2 * view.width) + i];
    const Vec2 middle = texelOf(cliff.scene.surface.evaluate(sample).position);
    int lit = 0;
    for (int a = -width / 2; a <= width / 2; ++a) {
      for (int b = -width / 2; b <= width / 2; ++b) {
        lit += side(middle + Vec2(a, b)) * litSide > 0 ? 1 : 0;
      }
    }
    const double expected = static_cast<double>(lit) / (width * width);
    const float share =
        found.test.shares[static_cast<std::size_t>(view.height / 2 * view.width) + i];
    EXPECT_NEAR(share, expected, 0.05) << places[i];
    partly += expected > 0.1 && expected < 0.9 ? 1 : 0;
  }
  EXPECT_GT(partly, 5);
}

TEST(VarianceShadowMap, StretchesWhatBleedingLeaves) {
  const GlContext gl;
  const DisplacedCliff cliff;
  const RenderView view = atlasView(cliff.scene.surface, 32);
  const auto shares = [&](double bleeding) {
    return cliff.scene
        .shares("variance-shadow-map", view, lightToward(180, 40), 0.01,
                {{"width", 65}, {"bleeding", bleeding}})
        .test.shares;
  };
  const auto all = shares(0);
  const auto cut = shares(0.4);
  int partly = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_NEAR(cut[i], std::clamp((all[i] - 0.4) / 0.6, 0.0, 1.0), 1e-4);
    partly += cut[i] > 0.1 && cut[i] < 0.9 ? 1 : 0;
  }
  EXPECT_GT(partly, 20);
}

/// x of the last dark pixel of the middle row, from the cliff on.
double lastDark(const DisplacedCliff& cliff, const RenderView& view, const Vec3& light,
                const std::map<std::string, double>& parameters) {
  const std::vector<double> places = cliff.places(view);
  const Mask mask = cliff.scene.answers("screen-space", view, light, parameters).test;
  double end = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto row = static_cast<std::size_t>(view.height / 2 * view.width);
    if (mask.samples[row + i] == Shade::shadowed) end = std::max(end, places[i]);
  }
  return end;
}

/// From above, 110 over the ground: a ray that passes below the cliff's top by more than an eighth
/// of the thickness is stopped, since a sample shades all within 7/8 of its middle's distance. Two
/// of the four rows must be, a pixel apart, and the first sample is up to a pixel behind the edge.
TEST(ScreenSpace, EndsAWallsShadowWhereTheThicknessSays) {
  const GlContext gl;
  const DisplacedCliff cliff;
  const RenderView view =
      cameraView(test::cameraAt({0, 0, 110}, {0, 0, 0}, 30, 192), cliff.scene.displaced.mesh);
  const auto endOf = [&](double thickness, double samples) {
    return lastDark(cliff, view, lightToward(180, 45),
                    {{"thickness", thickness}, {"samples", samples}});
  };
  const double pixel = 110 * 2 * std::tan(radians(15)) / 192;
  for (const double thickness : {0.02, 0.05, 0.15}) {
    EXPECT_NEAR(endOf(thickness, 120), 29.5 - thickness / 8 * 105 - 2 * pixel, pixel) << thickness;
  }
  // As many pixels as samples, the last of which fade.
  EXPECT_LT(endOf(0.05, 16), 19.5 + 17 * pixel);
  EXPECT_GT(endOf(0.05, 16), 19.5 + 6 * pixel);
}

/// From 20 over the ground, so near that the way to the light's own place in the picture matters:
/// of it a ray at the height z has (20 - z) / 20 before it, so that the cliff, 10 high, stands over
/// the ray by (10 - z) / 10 of the point's nearness, of which an eighth of the thickness must be
/// left. The cliff's edge, 4.5 beside the eye's foot and two pixels more as above, is seen where
/// the ray is at x = -a (20 - z), a = 4.5 / 10, and z = x of the point - x.
TEST(ScreenSpace, MeasuresTheThicknessByTheWayToTheLight) {
  const GlContext gl;
  const DisplacedCliff cliff;
  const RenderView view =
      cameraView(test::cameraAt({0, 0, 20}, {0, 0, 0}, 53, 192), cliff.scene.displaced.mesh);
  const double pixel = 2 * std::tan(radians(53.0 / 2)) / 192;
  const double a = 0.45 + 2 * pixel;
  for (const double thickness : {0.4, 0.8}) {
    const double end =
        lastDark(cliff, view, lightToward(180, 45), {{"thickness", thickness}, {"samples", 200}});
    const double z = 10 * (1 - thickness / 8);
    EXPECT_NEAR(end, 24 + z * (1 + a) - 20 * a, 20 * pixel) << thickness;
  }
}

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
