// What the section says of a pixel against what the shaders answered there.

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>

#include "model/cross_section.h"
#include "relief/patterns.h"
#include "render/render_scene.h"
#include "render/soft/soft_light.h"
#include "truth/truth_scenes.h"

namespace gnomon::app {
namespace {

using test::lightToward;
using test::randomRelief;
using test::RenderScene;
using test::shareShadowed;

using LitInSection = std::function<bool(const SectionHorizons&)>;

SectionTables tablesOf(const RenderScene& scene) {
  const horizon::TableShape& shape = scene.tables;
  return {scene.horizon, scene.distance, shape};
}

/// Share of a view's samples where the section and the shader differ.
double differingShare(const RenderScene& scene, const render::RenderView& view,
                      const std::string& method, const LitInSection& verdict) {
  const SectionTables tables = tablesOf(scene);
  const Vec3 light = lightToward(50, 30);
  const surface::SampleGrid samples = scene.samples(view);
  const Mask mask = scene.test(method, view, light);
  EXPECT_GT(shareShadowed(mask), 0.1);
  EXPECT_LT(shareShadowed(mask), 0.9);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const auto section = crossSection(scene.surface, scene.relief, samples.samples[i], light,
                                      {scene.tables.radiusTexels, 0}, &tables);
    const bool dark = verdict(section.value().fromTables.value());
    differ += dark != (mask.samples[i] == Shade::shadowed) ? 1 : 0;
  }
  return static_cast<double>(differ) / static_cast<double>(mask.size());
}

bool flat(const SectionHorizons& at) {
  return at.flat.shadowed;
}
bool of2003(const SectionHorizons& at) {
  return at.onoue2003;
}
bool of2004(const SectionHorizons& at) {
  return at.onoue2004;
}
bool exact(const SectionHorizons& at) {
  return at.onoueExact;
}

/// The base mesh is so fine that its frames are the limit surface's but for rounding.
void expectAgreement(const RenderScene& scene, const render::RenderView& view) {
  EXPECT_LT(differingShare(scene, view, "max-forsyth", flat), 1e-3);
  EXPECT_LT(differingShare(scene, view, "onoue-2003", of2003), 1e-3);
  EXPECT_LT(differingShare(scene, view, "onoue-2004", of2004), 1e-3);
  EXPECT_LT(differingShare(scene, view, "onoue-exact", exact), 1e-3);
  // The methods differ here, so that the agreement says something.
  EXPECT_GT(differingShare(scene, view, "onoue-2004", flat), 0.01);
  EXPECT_GT(differingShare(scene, view, "onoue-2004", exact), 0.002);
}

TEST(CrossSection, SaysOfEveryPixelWhatTheShaderAnswers) {
  const render::GlContext gl;
  for (const relief::HeightSpace space :
       {relief::HeightSpace::world, relief::HeightSpace::texture}) {
    relief::Relief relief = randomRelief(64, 32, 2, 21);
    relief.space = space;
    const RenderScene scene(surface::makeTorus(30, 10, 96, 66), relief, {16, 6},
                            horizon::TableBits::sixteen, 6);
    expectAgreement(scene, render::atlasView(scene.surface, 1));
  }
}

/// The mean of |ΔV| between the section and the shader that holds its horizon against the disc.
double meanDifference(const RenderScene& scene, const render::RenderView& view,
                      const std::string& method,
                      const std::function<double(const SectionHorizons&)>& share) {
  const SectionTables tables = tablesOf(scene);
  const Vec3 light = lightToward(50, 30);
  const double radius = radians(8.0);
  const surface::SampleGrid samples = scene.samples(view);
  const Visibility drawn =
      scene
          .shares(render::readMethod(render::methodFile(render::shaderFolder(), method)), view,
                  light, radius, render::SoftAnswer::disc)
          .test;
  Visibility found = drawn;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto section = crossSection(scene.surface, scene.relief, samples.samples[i], light,
                                      {scene.tables.radiusTexels, 0, radius}, &tables);
    found.shares[i] = static_cast<float>(share(section.value().fromTables.value()));
  }
  return test::meanDifference(drawn, found);
}

TEST(CrossSection, SeesOfADiscWhatTheShaderAnswers) {
  const render::GlContext gl;
  const RenderScene scene(surface::makeTorus(30, 10, 96, 66), randomRelief(64, 32, 2, 21), {16, 6},
                          horizon::TableBits::sixteen, 6);
  const render::RenderView view = render::atlasView(scene.surface, 1);
  const auto of2004 = [](const SectionHorizons& at) { return at.onoue2004Share; };
  const auto exactly = [](const SectionHorizons& at) { return at.onoueExactShare; };
  EXPECT_LT(
      meanDifference(scene, view, "max-forsyth", [](const auto& at) { return at.flat.share; }),
      1e-3);
  EXPECT_LT(meanDifference(scene, view, "onoue-2004", of2004), 1e-3);
  EXPECT_LT(meanDifference(scene, view, "onoue-exact", exactly), 1e-3);
  EXPECT_GT(meanDifference(scene, view, "max-forsyth", of2004), 0.01);
}

/// z = 0.005 (x² + y²), 96 wide: a surface on which the 2003 paper falls back to the flat horizon.
surface::Cage bowl() {
  const std::array<double, 4> square = {2304, -768, -768, 2304};  // the blossoms of x²
  std::array<Vec3, 16> points{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    points.at(k) = {-48 + 32.0 * static_cast<double>(k % 4),
                    -48 + 32.0 * static_cast<double>(k / 4),
                    0.005 * (square.at(k % 4) + square.at(k / 4))};
  }
  return surface::makeBezier(points, 48, 48);
}

TEST(CrossSection, SaysInABowlWhatTheShaderAnswers) {
  const render::GlContext gl;
  const relief::Relief relief{relief::makeColumns(96, 96, {32, 8, 1}, 8, relief::Wrap::clamp),
                              relief::HeightSpace::world, Vec2(1)};
  const RenderScene scene(bowl(), relief, {16, 24}, horizon::TableBits::sixteen, 4);
  const render::RenderView view = render::atlasView(scene.surface, 1);
  expectAgreement(scene, view);
  EXPECT_GT(differingShare(scene, view, "onoue-2003", of2004), 0.01);
}

}  // namespace
}  // namespace gnomon::app
