#include "render/held_targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "render/method_text.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::lightToward;
using test::methodOfText;
using test::RenderScene;
using test::stepScene;

TEST(HeldTargets, AreOneOfEachKindAndOfTheLastSize) {
  const GlContext gl;
  HeldTargets targets;
  const GLuint bits = targets.get(8, 4, {GL_R8UI}).framebuffer();
  EXPECT_EQ(targets.get(8, 4, {GL_R8UI}).framebuffer(), bits);
  EXPECT_NE(targets.get(8, 4, {GL_R32F}).framebuffer(), bits);
  const Target& other = targets.get(4, 8, {GL_R8UI});
  EXPECT_EQ(other.width(), 4);
  EXPECT_EQ(other.height(), 8);
}

/// What one method left in them, or one light, does not show through under the next.
TEST(HeldTargets, LeaveNothingForTheNextAnswer) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  const relief::Wrap wrap = scene.relief.field.wrap();
  const auto targets = std::make_shared<HeldTargets>();
  // From either side, so that a sample of one picture is background in the next.
  const auto viewFrom = [&](double x) {
    return cameraView(Camera{{x, 0, 60}, {0.6 * x, 0, 0}, {0, 1, 0}, 0.5, 48, 40}, scene.mesh);
  };
  const auto answersOf = [&](const char* test, const RenderView& view,
                             const std::shared_ptr<HeldTargets>& held) {
    const Method method = methodOfText("", std::string("bool isShadowed(Pixel pixel, LocalLight "
                                                       "light) { return ") +
                                               test + "; }");
    const MethodPass pass(shaderFolder(), method, wrap, TableFilter::exact, {}, SoftAnswer::own,
                          held);
    MethodAnswers answers;
    scene.withInputs(method, {}, [&](Drawing drawn, const GpuTables& gpu) {
      drawn.light.direction = lightToward(20, 30);
      answers = pass.render(view, drawn, gpu);
    });
    return answers;
  };
  for (const char* test : {"true", "pixel.texel.x > 5.0", "false", "pixel.texel.y > 3.0"}) {
    for (const double x : {-12, 12}) {
      const RenderView view = viewFrom(x);
      const MethodAnswers own = answersOf(test, view, nullptr);
      const MethodAnswers held = answersOf(test, view, targets);
      EXPECT_TRUE(isSame(own.drawn, held.drawn)) << test << x;
      EXPECT_TRUE(isSame(own.test, held.test)) << test << x;
      const auto samples = [&](Shade shade) {
        return std::count(own.test.samples.begin(), own.test.samples.end(), shade);
      };
      EXPECT_GT(samples(Shade::none), 400);
      EXPECT_GT(samples(Shade::lit) + samples(Shade::shadowed), 100);
    }
  }
}

}  // namespace
}  // namespace gnomon::render
