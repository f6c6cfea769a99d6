// Where an open patch ends, for methods that march and for those with tables.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "relief/patterns.h"
#include "render/open_bowl.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::difference;
using test::flatRelief;
using test::lightToward;
using test::openBowl;
using test::RenderScene;
using test::shareShadowed;
using test::stepRelief;

/// The slope of the bowl is at most 0.32 √2, that is 24.4°: a light at 30° reaches all of it. The
/// circle that the bowl follows at its middle goes on and rises over that.
TEST(ReliefBorder, NothingStandsBeyondABorderForAnyMarch) {
  const GlContext gl;
  const relief::Relief endless = flatRelief(64, 64);
  relief::Relief ended = endless;
  ended.field = endless.field.withBorder({true, true});
  const RenderScene open(openBowl(), ended, {4, 128}, horizon::TableBits::eight, 4);
  const RenderScene on(openBowl(), endless, {4, 128}, horizon::TableBits::eight, 4);
  const RenderView view = atlasView(open.surface, 8);
  const Vec3 light = lightToward(20, 30);
  for (const char* method :
       {"geodesic-march", "resampled-horizon", "osculating-march", "surface-march"}) {
    EXPECT_EQ(shareShadowed(open.answer(method, view, light)), 0) << method;
  }
  EXPECT_GT(shareShadowed(on.answer("geodesic-march", view, light)), 0.1);
  EXPECT_GT(shareShadowed(on.answer("osculating-march", view, light)), 0.1);
}

/// A ray at the slope s from x toward the bowl's border at x = 32 passes it where (32 + x) / 200 <
/// s. Half a texel more of the surface would hide half a texel more.
TEST(ReliefBorder, MarchesEndAtTheBorderItself) {
  const GlContext gl;
  relief::Relief flat = flatRelief(64, 64);
  flat.field = flat.field.withBorder({true, true});
  const RenderScene scene(openBowl(), flat, {4, 128}, horizon::TableBits::eight, 4);
  const RenderView view = atlasView(scene.surface, 8);
  const surface::SampleGrid grid = scene.samples(view);
  const auto endingAt = [&](double end) {
    Mask exact{view.width, view.height, std::vector<Shade>(grid.samples.size(), Shade::none)};
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double x = scene.surface.tangentPoint(grid.samples[i]).position.x;
      exact.samples[i] = (end + x) / 200 < 0.25 ? Shade::lit : Shade::shadowed;
    }
    return exact;
  };
  const Vec3 light = glm::normalize(Vec3(1, 0, 0.25));
  for (const char* method : {"surface-march", "geodesic-march", "resampled-horizon"}) {
    const Mask answer = scene.answer(method, view, light);
    EXPECT_LT(difference(answer, endingAt(32)), 1e-3) << method;
    EXPECT_GT(difference(answer, endingAt(32.5)), 5e-3) << method;
  }
}

/// A wall on the far side of a repeating map's border, where the next tile would have it.
TEST(ReliefBorder, TheNextTileOfAnOpenPatchCastsNoShadow) {
  const GlContext gl;
  const relief::Relief tiled = stepRelief(
      64, 64, 8, [](int i, int) { return i >= 4 && i < 8; }, relief::Wrap::repeat);
  relief::Relief ended = tiled;
  ended.field = tiled.field.withBorder({true, true});
  const RenderScene tiles(surface::makePlane(64, 64, 8, 8), tiled, {4, 40},
                          horizon::TableBits::thirtyTwo);
  const RenderScene patch(surface::makePlane(64, 64, 8, 8), ended, {4, 40},
                          horizon::TableBits::thirtyTwo);
  const RenderView view = atlasView(tiles.surface, 9);
  // Toward +x the wall is behind all that lies more than 8 texels from it.
  const surface::SampleGrid grid = tiles.samples(view);
  const auto shadowedPastTheWall = [&](const RenderScene& scene, const char* method) {
    const Mask mask = scene.answer(method, view, lightToward(0, 30));
    std::size_t dark = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const surface::SurfaceSample& at = grid.samples[i];
      const double x = scene.surface.tangentPoint(at).position.x;
      dark += x > -20 && mask.samples[i] == Shade::shadowed ? 1 : 0;
    }
    return dark;
  };
  for (const char* method :
       {"max-forsyth", "sloan-cohen", "ellipse", "onoue-2004", "onoue-exact", "resampled-horizon",
        "relief-march", "osculating-march", "geodesic-march"}) {
    EXPECT_EQ(shadowedPastTheWall(patch, method), 0U) << method;
    EXPECT_GT(shadowedPastTheWall(tiles, method), 100U) << method;
  }
  // It has seen the surface.
  EXPECT_EQ(shadowedPastTheWall(tiles, "surface-march"), 0U);
  EXPECT_EQ(shadowedPastTheWall(patch, "surface-march"), 0U);
}

}  // namespace
}  // namespace gnomon::render
