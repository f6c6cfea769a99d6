// Where two methods must agree, or one must tend to the other.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "relief/patterns.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::difference;
using test::lightToward;
using test::randomRelief;
using test::RenderScene;
using test::shareShadowed;

/// A bowl that opens upward: curvature below 0 everywhere, about -1/100.
surface::Cage bowl() {
  std::array<Vec3, 16> points{};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const Vec2 place = 32.0 * (Vec2(i, j) / 1.5 - 1.0);
      // The control heights of z = (x² + y²) / 200: the blossom of x² at the four points.
      const double ends = 32.0 * 32.0;
      const auto square = [&](int k) { return k == 0 || k == 3 ? ends : -ends / 3; };
      points[static_cast<std::size_t>(4 * j + i)] = Vec3(place, (square(i) + square(j)) / 200);
    }
  }
  return surface::makeBezier(points, 16, 16);
}

Mask with(const RenderScene& scene, const std::string& method, const RenderView& view,
          const Vec3& light, const std::map<std::string, double>& parameters) {
  const Method read = readMethod(methodFile(shaderFolder(), method));
  return scene.answer(read, view, light, TableFilter::exact, parameters);
}

TEST(MethodLimits, TheEarlierPaperIsTheFlatMethodWhereTheSurfaceIsConcave) {
  const GlContext gl;
  const RenderScene scene(bowl(), randomRelief(64, 64, 3, 3), {32, 64}, horizon::TableBits::eight,
                          2);
  const RenderView view = atlasView(scene.surface, 16);
  const Vec3 light = lightToward(20, 35);
  const Mask mask = scene.test("onoue-2003", view, light);
  EXPECT_EQ(difference(mask, scene.test("max-forsyth", view, light)), 0);
  EXPECT_GT(difference(mask, scene.test("onoue-2004", view, light)), 0.01);
}

TEST(MethodLimits, TheEarlierPaperIsTheLaterOneWhereTheSurfaceIsConvex) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(60, 1, 1, 32, 32), randomRelief(64, 64, 3, 3),
                          {32, 64}, horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  const Vec3 light = lightToward(20, 35);
  const Mask mask = scene.test("onoue-2003", view, light);
  EXPECT_EQ(difference(mask, scene.test("onoue-2004", view, light)), 0);
  EXPECT_GT(difference(mask, scene.test("max-forsyth", view, light)), 0.01);
}

TEST(MethodLimits, ExactFormulaTendsToThePublishedOneAsCurvatureVanishes) {
  const GlContext gl;
  const Vec3 light = lightToward(20, 35);
  const auto differenceAt = [&](double radius) {
    const RenderScene scene(surface::makeSphere(radius, 64 / radius, 64 / radius, 32, 32),
                            randomRelief(64, 64, 3, 3), {32, 64}, horizon::TableBits::sixteen);
    const RenderView view = atlasView(scene.surface, 16);
    return difference(scene.test("onoue-exact", view, light),
                      scene.test("onoue-2004", view, light));
  };
  const double curved = differenceAt(60);
  const double gentle = differenceAt(240);
  const double nearlyFlat = differenceAt(3840);
  EXPECT_GT(curved, 5e-3);
  EXPECT_LT(gentle, curved / 2);
  EXPECT_LT(nearlyFlat, gentle / 4);
}

TEST(MethodLimits, OnAPlaneTheOsculatingMarchIsTheFlatOne) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(32, 32, 8, 8), randomRelief(32, 32, 4, 3), {4, 12},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 9);
  for (const double elevation : {60.0, 35.0, 20.0}) {
    const Vec3 light = lightToward(20, elevation);
    // Strides of at most 4 / tan 20° / 512 = 0.02 texels against 0.02: both find the same bumps but
    // for rays that graze one by less than half a stride.
    const Mask flat = with(scene, "relief-march", view, light, {{"steps", 512}});
    const Mask circle = with(scene, "osculating-march", view, light, {{"stride", 0.02}});
    EXPECT_LT(difference(flat, circle), 2e-3) << elevation;
    EXPECT_GT(shareShadowed(flat), 0.05);
  }
}

TEST(MethodLimits, OnAPlaneHorizonMapsTendToTheMarchAsTexelsShrink) {
  const GlContext gl;
  // The light in one of the 72 azimuths: what is left is the interpolation between texels, which
  // moves a shadow's edge by less than a texel.
  const Vec3 light = lightToward(20, 14);
  const auto differenceAt = [&](int texels, const std::string& method) {
    const relief::Relief relief{
        relief::makeCosine(texels, texels, {texels / 4.0}, 4, relief::Wrap::repeat),
        relief::HeightSpace::world, Vec2(1)};
    const RenderScene scene(surface::makePlane(64, 64, 8, 8), relief,
                            {72, static_cast<double>(texels)}, horizon::TableBits::thirtyTwo);
    const RenderView view = atlasView(scene.surface, 33);
    const Mask march = with(scene, "relief-march", view, light, {{"steps", 512}});
    EXPECT_GT(shareShadowed(march), 0.1);
    EXPECT_LT(shareShadowed(march), 0.9);
    return difference(scene.test(method, view, light), march);
  };
  for (const char* method : {"max-forsyth", "onoue-2003", "onoue-2004", "onoue-exact"}) {
    const double coarse = differenceAt(64, method);
    const double fine = differenceAt(256, method);
    EXPECT_GT(coarse, 0) << method;
    EXPECT_LT(fine, coarse / 3) << method;
    EXPECT_LT(fine, 0.01) << method;
  }
}

TEST(MethodLimits, FewStepsMissBumps) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(64, 64, 8, 8), randomRelief(64, 64, 4, 3), {4, 8},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  const Vec3 light = lightToward(20, 20);
  // A march finds no shadow that is not there: with more steps there is only more.
  double before = -1;
  for (const double steps : {1.0, 4.0, 16.0, 256.0}) {
    const double now = shareShadowed(with(scene, "relief-march", view, light, {{"steps", steps}}));
    EXPECT_GT(now, before);
    before = now;
  }
}

}  // namespace
}  // namespace gnomon::render
