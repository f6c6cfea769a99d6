// Methods of engines that draw the displaced mesh, each against a closed form.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "render/displaced_rays.h"
#include "render/engines/engine_methods.h"

namespace gnomon::render {
namespace {

using test::lightToward;

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

}  // namespace
}  // namespace gnomon::render
