#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "horizon/reference.h"
#include "relief/patterns.h"
#include "render/render_scene.h"
#include "surface/curvature.h"
#include "surface/texel_frame.h"
#include "truth/truth_scenes.h"

// The shaders against closed forms, and against the same formulas in double precision on the limit
// surface itself.
// Where two methods must agree, or one must tend to the other.

namespace gnomon::render {
namespace {

using test::difference;
using test::flatRelief;
using test::lightToward;
using test::MirroredScenes;
using test::randomRelief;
using test::RenderScene;
using test::shareShadowed;
using test::stepRelief;

/// Eq. (3): the tip of a pin of height h on a bare sphere is lit down to -arccos(R / (R + h)).
TEST(PublishedMethods, CurvatureAwareTipOfAPinIsLitDownToTheSpheresHorizon) {
  const GlContext gl;
  constexpr double radius = 60;
  constexpr double height = 5;
  const RenderScene scene(
      surface::makeSphere(radius, 1.35, 1.35, 81, 81),
      stepRelief(81, 81, height, [](int i, int j) { return i == 40 && j == 40; }), {32, 40},
      horizon::TableBits::thirtyTwo);
  // One face a texel and one sample a face: the sample of the middle face is the pin's tip.
  const RenderView view = atlasView(scene.surface, 1);
  const std::size_t tip = 40 * 81 + 40;
  const double dip = std::acos(radius / (radius + height)) * 180 / pi;
  for (const double azimuth : {0.0, 33.0, 190.0}) {
    for (const char* method : {"onoue-2003", "onoue-2004", "onoue-exact", "osculating-march",
                               "geodesic-march", "resampled-horizon"}) {
      const auto shade = [&](double elevation) {
        return scene.test(method, view, lightToward(azimuth, elevation)).samples[tip];
      };
      EXPECT_EQ(shade(-dip + 0.05), Shade::lit) << method << " " << azimuth;
      EXPECT_EQ(shade(-dip - 0.05), Shade::shadowed) << method << " " << azimuth;
    }
  }
}

TEST(PublishedMethods, BareConvexSurfaceEndsAtTheTerminator) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(40, 2.4, 1.2, 64, 32), flatRelief(96, 48), {8, 40},
                          horizon::TableBits::eight, 4);
  const RenderView view = atlasView(scene.surface, 4);
  const Vec3 light = lightToward(0, 30);
  const surface::SampleGrid samples = scene.samples(view);
  for (const char* method :
       {"unshadowed", "max-forsyth", "onoue-2003", "onoue-2004", "onoue-exact", "relief-march",
        "osculating-march", "geodesic-march", "resampled-horizon", "surface-march"}) {
    const Mask mask = scene.answer(method, view, light);
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const surface::SurfaceSample& sample = samples.samples[i];
      const double cosine = glm::dot(scene.surface.evaluate(sample).position / 40.0, light);
      if (std::abs(cosine) < 1e-3) continue;
      ASSERT_EQ(mask.samples[i], cosine > 0 ? Shade::lit : Shade::shadowed) << method;
    }
  }
}

/// A method's answer on the exact frame of the limit surface.
template <typename Formula>
bool referenceShadowed(const RenderScene& scene, const surface::LimitPoint& point,
                       const Vec3& light, const Formula& formula) {
  const surface::TexelFrame frame = surface::texelFrame(point, scene.relief.texelsPerUv());
  const surface::LocalLight local = surface::localLight(frame, light);
  const double scale = relief::worldPerHeight(scene.relief.space, frame);
  const auto entry = [&](const horizon::StoredTable& table) {
    return horizon::filteredValue(table, scene.tables, frame.texel, local.azimuth());
  };
  const horizon::HorizonLookups at{surface::normalCurvature(point, light),
                                   scale * scene.relief.field.at(frame.texel),
                                   scale * entry(scene.horizon) / local.worldPerTexel,
                                   entry(scene.distance) * local.worldPerTexel};
  return !(local.slope > std::max(formula(at), horizon::bareHorizon(at.curvature, at.height)));
}

/// Base frames of a fine mesh are those of the limit surface up to its chords: what differs is
/// rounding near the threshold.
template <typename Formula>
void expectFormula(const Method& method, const std::map<std::string, double>& parameters,
                   const Formula& formula) {
  for (const relief::HeightSpace space :
       {relief::HeightSpace::world, relief::HeightSpace::texture}) {
    relief::Relief relief = randomRelief(64, 32, 2, 21);
    relief.space = space;
    // A torus: curvature of both signs, frames that are neither square nor even.
    const RenderScene scene(surface::makeTorus(30, 10, 96, 66), relief, {16, 6},
                            horizon::TableBits::sixteen, 6);
    const RenderView view = atlasView(scene.surface, 3);
    const surface::SampleGrid samples = scene.samples(view);
    const Vec3 light = lightToward(50, 30);
    const Mask mask = scene.test(method, view, light, TableFilter::exact, parameters);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const surface::SurfaceSample& sample = samples.samples[i];
      const bool dark = referenceShadowed(scene, scene.surface.evaluate(sample), light, formula);
      differ += dark != (mask.samples[i] == Shade::shadowed) ? 1 : 0;
    }
    EXPECT_GT(shareShadowed(mask), 0.2);
    EXPECT_LT(shareShadowed(mask), 0.9);
    EXPECT_LT(static_cast<double>(differ) / static_cast<double>(mask.size()), 1e-3) << method.name;
  }
}

template <typename Formula>
void expectFormula(const std::string& method, const Formula& formula) {
  expectFormula(readMethod(methodFile(shaderFolder(), method)), {}, formula);
}

TEST(PublishedMethods, CurvatureAwareShaderIsItsFormulaOnTheLimitSurface) {
  const GlContext gl;
  expectFormula("onoue-2004", horizon::smallAngleHorizon);
}

TEST(PublishedMethods, ExactShaderIsTheCirclesFormulaOnTheLimitSurface) {
  const GlContext gl;
  expectFormula("onoue-exact", horizon::osculatingHorizon);
}

/// (2) with the occluder's height in the place of the pixel's.
double smallAngleHorizonOfAll(const horizon::HorizonLookups& at) {
  const double peak = at.height + at.slope * at.arcLength;
  return at.slope * (1 - at.curvature * peak) - at.curvature * at.arcLength / 2;
}

TEST(HorizonLadder, SwitchesAreTheirFormulasOnTheLimitSurface) {
  const GlContext gl;
  const Method ladder = readMethod(std::string(GNOMON_SCENES) + "/methods/horizon-ladder.glsl");
  expectFormula(ladder, {{"angles", 1}}, horizon::unreducedHorizon);
  expectFormula(ladder, {{"denominator", 1}}, smallAngleHorizonOfAll);
}

/// Kept in the denominator, the term makes (2) the exact form to first order in the curvature: what
/// is left shrinks with its square. As published, (2) is not.
TEST(HorizonLadder, TheDroppedTermIsOfFirstOrder) {
  const auto errors = [](double curvature) {
    const horizon::HorizonLookups at{curvature, 3, 0.4, 10};
    const double exact = horizon::osculatingHorizon(at);
    return std::pair(std::abs(smallAngleHorizonOfAll(at) - exact),
                     std::abs(horizon::smallAngleHorizon(at) - exact));
  };
  const auto [kept, dropped] = errors(1e-3);
  const auto [keptAtHalf, droppedAtHalf] = errors(5e-4);
  EXPECT_NEAR(kept / keptAtHalf, 4, 0.1);
  EXPECT_NEAR(dropped / droppedAtHalf, 2, 0.1);
}

/// As the truth's own test: the ground behind a wall on a sphere, in the light's plane, is shadowed
/// where the wall's upper edge, on the circle, stands over the light.
TEST(PublishedMethods, MarchOnTheCircleEndsAShadowWhereTheCircleSays) {
  const GlContext gl;
  constexpr double radius = 80;
  constexpr double height = 6;
  const RenderScene scene(surface::makeSphere(radius, 1.6, 0.4, 64, 16),
                          stepRelief(128, 32, height, [](int i, int) { return i >= 60 && i < 64; }),
                          {4, 64}, horizon::TableBits::eight, 4);
  const RenderView view = atlasView(scene.surface, 15);
  const Mask mask = scene.test("osculating-march", view, lightToward(180, 25));
  const double edge = (63.5 - 64) / 128 * 1.6;  // longitude of the wall's upper edge
  const auto longitude = [&](int column) { return ((column + 0.5) / view.width - 0.5) * 1.6; };
  double found = 0;
  double expected = 0;
  for (int column = 0; column < view.width; ++column) {
    const double at = longitude(column);
    if (at < (64.6 - 64) / 128 * 1.6 || at > radians(24)) continue;  // the lee face; the terminator
    const auto i = static_cast<std::size_t>(view.height / 2 * view.width + column);
    if (mask.samples[i] == Shade::shadowed) found = at;
    const double angle = at - edge;
    const double horizon = (std::cos(angle) - radius / (radius + height)) / std::sin(angle);
    if (std::tan(radians(25) - at) < horizon) expected = at;
  }
  ASSERT_GT(expected, 0.05);
  ASSERT_LT(expected, radians(20));
  // A stride of a quarter texel of 1.6 / 128 may step over the edge's very top.
  EXPECT_NEAR(found, expected, 0.25 * 1.6 / 128 + 1.6 / view.width);
}

TEST(PublishedMethods, MirroredTextureGivesTheMirroredRelief) {
  // u runs backward and the map with it: the relief in the world is the same, and so must the mask
  // be.
  const GlContext gl;
  const MirroredScenes scenes(32);
  const Vec3 light = lightToward(20, 30);
  for (const char* method : {"max-forsyth", "onoue-2004", "unshadowed", "geodesic-march",
                             "resampled-horizon", "surface-march"}) {
    // The mirrored cage has no chart, so its atlas of 16 × 16 tiles is the same by its number of
    // faces.
    const Mask a = scenes.scene.answer(method, atlasView(scenes.scene.surface, 8), light);
    const Mask b = scenes.mirrored.answer(method, atlasView(scenes.mirrored.surface, 8), light);
    EXPECT_LT(difference(a, b), 5e-4) << method;
    EXPECT_GT(shareShadowed(a), 0.1) << method;
  }
}

TEST(PublishedMethods, HardwareFilterChangesLittleButSomething) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(60, 1, 1, 32, 32), randomRelief(64, 64, 4, 3),
                          {32, 64}, horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  const Vec3 light = lightToward(20, 35);
  const double change = difference(scene.test("onoue-2004", view, light),
                                   scene.test("onoue-2004", view, light, TableFilter::hardware));
  EXPECT_GT(change, 0);
  EXPECT_LT(change, 0.01);
}

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
