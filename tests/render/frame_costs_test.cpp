#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>

#include "render/passes/texel_counter.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::RenderScene;

/// A method of one pass, one that draws the light's depth first, and one whose march through the
/// camera's depth reads as many texels as that tells.
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
    drawing.light = test::lightToward(20, 30);
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

INSTANTIATE_TEST_SUITE_P(Methods, FrameCostsOf,
                         testing::Values("max-forsyth", "shadow-map", "screen-space"));

}  // namespace
}  // namespace gnomon::render
