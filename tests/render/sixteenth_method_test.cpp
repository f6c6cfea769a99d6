#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "render/render_scene.h"

// A method that brings a bake, two passes, an include and a whole number, on ground whose shadows
// are known: a bar across a plane, under lights along the axes.

namespace gnomon::render {
namespace {

constexpr int barTexels = 64;
constexpr double barHeight = 6;

Method sixteenth() {
  const std::filesystem::path tests =
      std::filesystem::path(GNOMON_SCENES).parent_path() / "tests/render";
  return readMethod(tests / "sixteenth/sixteenth.glsl");
}

/// How far a place is from the side of the bar's shadow, texels; above 0 inside it. The bar is
/// from texel 30 to 34 of an axis, and heights fall to 0 within a texel beside it.
double insideShadow(double along, bool towardHigher, double length) {
  const double way = towardHigher ? 30 - along : along - 34;
  return std::min(way, length - way);
}

/// A bar that stands across x, or across y.
relief::Relief bar(bool acrossX) {
  return test::stepRelief(barTexels, barTexels, barHeight, [acrossX](int x, int y) {
    const int along = acrossX ? x : y;
    return along >= 30 && along < 34;
  });
}

TEST(SixteenthMethod, ShadowsABarAsLongAsItMustBe) {
  const GlContext gl;
  const Method method = sixteenth();
  EXPECT_EQ(method.passes.count(), 3);
  ASSERT_EQ(method.includes.size(), 1U);
  const double length = 20;
  const double elevation = std::atan(barHeight / length);
  for (int axis = 0; axis < 4; ++axis) {
    const bool acrossX = axis % 2 == 0;
    const test::RenderScene scene(surface::makePlane(barTexels, barTexels, 4, 4), bar(acrossX),
                                  {4, 64}, horizon::TableBits::eight);
    const double azimuth = axis * pi / 2;
    const Vec3 light(std::cos(azimuth) * std::cos(elevation),
                     std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
    const RenderView view = atlasView(scene.surface, 32);
    const surface::SampleGrid samples =
        SamplesPass(shaderFolder()).render(view, GpuMesh(scene.mesh));
    for (const auto& [reach, reached] : {std::pair(40, length), std::pair(10, 10.0)}) {
      const Mask mask = scene.test(method, view, light, TableFilter::exact,
                                   {{"reach", static_cast<double>(reach)}});
      std::size_t inside = 0;
      for (std::size_t i = 0; i < mask.size(); ++i) {
        const surface::SurfaceSample& sample = samples.samples[i];
        const Vec3 place = scene.surface.evaluate(sample.face, sample.s, sample.t).position;
        const double along = (acrossX ? place.x : place.y) + barTexels / 2.0;
        const double depth = insideShadow(along, axis < 2, reached);
        if (std::abs(depth) < 2 || (along > 29 && along < 35)) continue;
        EXPECT_EQ(mask.samples[i], depth > 0 ? Shade::shadowed : Shade::lit)
            << "light " << axis << " at " << along;
        inside += depth > 0 ? 1 : 0;
      }
      EXPECT_GT(inside, 100U);
    }
  }
}

}  // namespace
}  // namespace gnomon::render
