#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>

#include "render/method_text.h"
#include "render/passes/texel_counter.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::RenderScene;

/// A method of one pass, one that draws the light's depth first, and one that draws the camera's.
class FrameCostsOf : public testing::TestWithParam<const char*> {};

TEST_P(FrameCostsOf, MayCountTheFrameThatDrewTheAnswers) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(16, 16, 2, 2),
                          test::stepRelief(16, 16, 3, [](int i, int) { return i < 8; }), {8, 16},
                          horizon::TableBits::thirtyTwo);
  const Method method = readMethod(methodFile(shaderFolder(), GetParam()));
  const relief::Wrap wrap = scene.relief.field.wrap();
  const MethodPass pass(shaderFolder(), method, wrap, TableFilter::exact, {});
  const TexelCounter counter(shaderFolder(), method, wrap, TableFilter::exact, {});
  Camera camera;
  camera.eye = {3, -30, 20};
  camera.target = {0, 0, 0};
  camera.width = 48;
  camera.height = 32;
  const RenderView view = cameraView(camera, scene.mesh);
  scene.withInputs(method, {}, [&](Drawing drawing, const GpuTables& tables) {
    drawing.light.direction = test::lightToward(20, 30);
    EXPECT_FALSE(pass.isWarm(drawing));
    const MethodAnswers plain = pass.render(view, drawing, tables);
    EXPECT_TRUE(pass.isWarm(drawing));
    int drawn = 0;
    const MethodAnswers timed =
        pass.render(view, drawing, tables, [&](const std::function<void()>& draw) {
          ++drawn;
          draw();
        });
    EXPECT_EQ(drawn, 1);
    EXPECT_EQ(timed.drawn.samples, plain.drawn.samples);
    EXPECT_EQ(timed.test.samples, plain.test.samples);

    const auto costs = [&](std::optional<double> drawnIn) {
      return pass.frameCosts(view, drawing, tables, {1, 100}, drawnIn, FrameClock::wall, counter);
    };
    const FrameCosts own = costs({});
    const FrameCosts given = costs(1234.5);
    EXPECT_NE(own.every, 1234.5);
    EXPECT_EQ(given.every, 1234.5);
    EXPECT_EQ(given.texels, own.texels);
    EXPECT_GT(own.texels, 0);
    if (pass.passBytes(&view, drawing, tables) == 0) {
      EXPECT_EQ(given.still, 1234.5);
    }
  });
}

/// A frame that was timed earlier left nothing in these targets.
TEST(FrameCosts, CountTexelsByWhatThePassesLeave) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(16, 16, 2, 2),
                          test::stepRelief(16, 16, 3, [](int i, int) { return i < 8; }), {8, 16},
                          horizon::TableBits::thirtyTwo);
  const Method method = test::methodOfText(
      "tables = [\"height\"]\nnormal = \"own\"\n"
      "[[pass]]\nname = \"many\"\nkind = \"texture\"\nchannels = 1\n",
      "float passMany(Pixel pixel) { return lightDirection.z > 0.9 ? 7.0 : 3.0; }\n"
      "bool isShadowed(Pixel pixel, LocalLight light) {\n"
      "  float sum = 0.0;\n"
      "  int count = int(manyAt(pixel.texel) + 0.5);\n"
      "  for (int i = 0; i < count; ++i) sum += texelFetch(heightMap, ivec2(i, 0), 0).r;\n"
      "  return sum < 0.0;\n}\n"
      "vec3 shadingNormal(Pixel pixel) { return pixel.normal; }\n");
  const relief::Wrap wrap = scene.relief.field.wrap();
  const MethodPass pass(shaderFolder(), method, wrap, TableFilter::exact, {});
  const TexelCounter counter(shaderFolder(), method, wrap, TableFilter::exact, {});
  const RenderView view = atlasView(scene.surface, 8);
  scene.withInputs(method, {}, [&](Drawing drawing, const GpuTables& tables) {
    const auto texels = [&](std::optional<double> drawnIn) {
      return pass.frameCosts(view, drawing, tables, {1, 100}, drawnIn, FrameClock::wall, counter)
          .texels;
    };
    drawing.light.direction = Vec3(0, 0, 1);
    (void)pass.render(view, drawing, tables);
    drawing.light.direction =
        test::lightToward(20, 30);  // what the memory still holds is wrong now
    const double given = texels(1234.5);
    const double own = texels({});
    EXPECT_GE(own, 3);
    EXPECT_LT(own, 7 + 4);
    EXPECT_EQ(given, own);
  });
}

INSTANTIATE_TEST_SUITE_P(Methods, FrameCostsOf,
                         testing::Values("max-forsyth", "shadow-map", "screen-space"));

}  // namespace
}  // namespace gnomon::render
