// The shader of the error budgets: with its switches it is each of the methods that it stands for.

#include <gtest/gtest.h>

#include <map>
#include <ostream>
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

using Switches = std::map<std::string, double>;

Mask ladder(const RenderScene& scene, const RenderView& view, const Vec3& light,
            const Switches& switches) {
  static const Method method =
      readMethod(std::string(GNOMON_SCENES) + "/methods/horizon-ladder.glsl");
  return scene.answer(method, view, light, TableFilter::exact, switches);
}

const Switches farEnd = {
    {"resampled", 1}, {"ruling", 1}, {"angles", 1}, {"denominator", 1}, {"along", 1}};

Switches without(Switches switches, const std::string& name) {
  switches.erase(name);
  return switches;
}

relief::Relief columns(relief::HeightSpace space) {
  return {relief::makeColumns(64, 64, {16, 4, 1}, 5, relief::Wrap::repeat), space, Vec2(1)};
}

/// A sphere, a bowl and a torus, whose curvature changes on the way; heights in the world's units
/// and in texels.
std::vector<RenderScene> scenes() {
  std::vector<RenderScene> list;
  const horizon::BakeSettings bake{16, 32};
  list.emplace_back(surface::makeSphere(60, 1.1, 1.1, 16, 16), columns(relief::HeightSpace::world),
                    bake, horizon::TableBits::eight);
  list.emplace_back(surface::makeSphere(60, 1.1, 1.1, 16, 16), randomRelief(64, 64, 5, 3), bake,
                    horizon::TableBits::sixteen);
  list.emplace_back(surface::makeTorus(30, 10, 72, 60), columns(relief::HeightSpace::texture), bake,
                    horizon::TableBits::eight);
  return list;
}

struct Same {
  const char* method;
  Switches switches;
};

void PrintTo(const Same& same, std::ostream* out) {
  *out << same.method;
}

class LadderIs : public testing::TestWithParam<Same> {};

/// To the bit: the same expressions in the same order.
TEST_P(LadderIs, TheMethodThatItStandsFor) {
  const GlContext gl;
  double shadowed = 0;
  for (const RenderScene& scene : scenes()) {
    const RenderView view = atlasView(scene.surface, 5);
    for (const Vec3& light : {lightToward(20, 40), lightToward(200, 20), lightToward(110, -10)}) {
      const Mask mask = ladder(scene, view, light, GetParam().switches);
      EXPECT_EQ(difference(mask, scene.answer(GetParam().method, view, light)), 0);
      shadowed += shareShadowed(mask) / 9;
    }
  }
  EXPECT_GT(shadowed, 0.1);
  EXPECT_LT(shadowed, 0.9);
}

INSTANTIATE_TEST_SUITE_P(Methods, LadderIs,
                         testing::Values(Same{"onoue-2004", {}},
                                         Same{"max-forsyth", {{"curved", 0}}},
                                         Same{"onoue-exact", {{"angles", 1}, {"denominator", 1}}},
                                         Same{"geodesic-march", farEnd}),
                         [](const auto& same) {
                           std::string name = same.param.method;
                           std::erase(name, '-');
                           return name;
                         });

/// Along straight lines with the sample's curvature it is the march on the circle, but for that
/// one's steps.
TEST(Ladder, WithoutThePathIsTheMarchOnTheCircle) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(60, 1.1, 1.1, 16, 16),
                          columns(relief::HeightSpace::world), {16, 32}, horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 9);
  const Method march = readMethod(methodFile(shaderFolder(), "osculating-march"));
  for (const Vec3& light : {lightToward(20, 40), lightToward(200, 20)}) {
    const Mask circle = scene.answer(march, view, light, TableFilter::exact, {{"stride", 0.02}});
    const Mask straight = ladder(scene, view, light, without(farEnd, "along"));
    EXPECT_LT(difference(circle, straight), 0.002);
    EXPECT_GT(difference(circle, ladder(scene, view, light, farEnd)), 0.004);
  }
}

/// The general search for the ruling horizon, one formula short of the far end, where that formula
/// hardly matters: at a curvature near 0.
TEST(Ladder, FindsTheRulingHorizon) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(4000, 0.016, 0.016, 8, 8),
                          columns(relief::HeightSpace::world), {16, 32}, horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 17);
  for (const Vec3& light : {lightToward(20, 40), lightToward(200, 20)}) {
    const Mask end = ladder(scene, view, light, farEnd);
    EXPECT_GT(shareShadowed(end), 0.05);
    EXPECT_LT(difference(end, ladder(scene, view, light, without(farEnd, "denominator"))), 0.002);
    EXPECT_LT(difference(end, ladder(scene, view, light, without(farEnd, "angles"))), 0.002);
  }
}

/// On a nearly flat surface the horizon that rules is the flat relief's: what `ruling` bakes in the
/// shader must be what the baker baked, code for code but for values near the middle of two codes.
TEST(Ladder, BakesWhatTheBakerBakes) {
  const GlContext gl;
  for (const horizon::TableBits bits : {horizon::TableBits::eight, horizon::TableBits::thirtyTwo}) {
    const RenderScene scene(surface::makeSphere(4000, 0.016, 0.016, 8, 8),
                            columns(relief::HeightSpace::world), {16, 32}, bits);
    const RenderView view = atlasView(scene.surface, 17);
    const double levels = bits == horizon::TableBits::eight ? 255 : 0;
    for (const Vec3& light : {lightToward(25, 40), lightToward(200, 20)}) {
      const Mask baked = ladder(scene, view, light, {{"curved", 0}});
      const Mask ruling =
          ladder(scene, view, light, {{"curved", 0}, {"ruling", 1}, {"levels", levels}});
      EXPECT_GT(shareShadowed(baked), 0.05);
      EXPECT_LT(difference(baked, ruling), 0.003);
    }
  }
}

/// On a plane without curvature no formula and no path matters.
TEST(Ladder, SwitchesOfCurvatureDoNothingOnAPlane) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(64, 64, 8, 8), columns(relief::HeightSpace::world),
                          {16, 32}, horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 17);
  const Vec3 light = lightToward(20, 30);
  const Mask published = ladder(scene, view, light, {});
  for (const char* name : {"angles", "denominator", "along"}) {
    EXPECT_LT(difference(published, ladder(scene, view, light, {{name, 1}})), 1e-3) << name;
  }
  EXPECT_EQ(difference(published, ladder(scene, view, light, {{"curved", 0}})), 0);
  EXPECT_GT(difference(published, ladder(scene, view, light, {{"resampled", 1}})), 1e-3);
}

/// Each switch does something by itself where there is curvature.
TEST(Ladder, EverySwitchChangesTheMask) {
  const GlContext gl;
  const RenderScene scene(surface::makeTorus(30, 10, 72, 60), columns(relief::HeightSpace::texture),
                          {16, 32}, horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 3);
  const Vec3 light = lightToward(20, 30);
  const Mask published = ladder(scene, view, light, {});
  for (const char* name : {"resampled", "ruling", "angles", "denominator", "along"}) {
    EXPECT_GT(difference(published, ladder(scene, view, light, {{name, 1}})), 0) << name;
  }
  EXPECT_GT(difference(ladder(scene, view, light, {{"ruling", 1}}),
                       ladder(scene, view, light, {{"ruling", 1}, {"levels", 3}})),
            0);
}

}  // namespace
}  // namespace gnomon::render
