#include "render/passes/loop_check.h"

#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "render/glsl_text.h"
#include "render/method_text.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

// Loops without an end are found before a frame is drawn, and others are not touched.

namespace gnomon::render {
namespace {

using test::lightToward;
using test::methodOfText;
using test::RenderScene;
using test::stepScene;
using ::testing::HasSubstr;

/// The samples of 8 × 8 a face, 4 faces, at which a method's loops do not end.
std::vector<std::size_t> endlessOf(const RenderScene& scene, const Method& method,
                                   double radius = 0,
                                   const std::map<std::string, double>& parameters = {}) {
  const relief::Wrap wrap = scene.relief.field.wrap();
  const MethodPass pass(shaderFolder(), method, wrap, TableFilter::exact, parameters);
  const LoopCheck check(shaderFolder(), method, wrap, TableFilter::exact, parameters);
  std::vector<std::size_t> endless;
  scene.withInputs(method, parameters, [&](Drawing drawn, const GpuTables& gpu) {
    drawn.light.direction = lightToward(20, 30);
    drawn.light.radius = radius;
    endless = pass.endlessSamples(atlasView(scene.surface, 8), drawn, gpu, check);
  });
  return endless;
}

std::size_t endlessIn(const RenderScene& scene, const std::string& body) {
  const Method method =
      methodOfText("", "bool isShadowed(Pixel pixel, LocalLight light) {\n  float x = 0.0;\n" +
                           body + "\n  return x > 1.0;\n}\n");
  return endlessOf(scene, method).size();
}

TEST(LoopCheck, KeepsTheTextThatIsNoLoop) {
  for (const std::string text :
       {"float forward = 1.0; // for (;;)\n/* while (true) */ int dodo;", "", "for", "while ("}) {
    EXPECT_EQ(withEndingLoops(text), text);
  }
}

TEST(LoopCheck, EndsEveryKindOfLoop) {
  for (const auto& [loop, ended] : std::vector<std::pair<std::string, std::string>>{
           {"for (int i = 0; i < f(2); ++i) x += 1.0;",
            "for (int i = 0; i < f(2); ++i) if (!nextTurn()) break; else x += 1.0;"},
           {"for(;;) {}", "for (;;) if (!nextTurn()) break; else {}"},
           {"while (g(x)) { x += 1.0; }",
            "while (g(x)) if (!nextTurn()) break; else { x += 1.0; }"},
           {"do { x += 1.0; } while (x < 3.0) ;",
            "do { x += 1.0; } while ((x < 3.0) && nextTurn()) ;"},
           {"while (h());", "while ((h()) && nextTurn());"}}) {
    EXPECT_EQ(withEndingLoops(loop), ended);
  }
}

TEST(LoopCheck, FindsTheSamplesAtWhichALoopDoesNotEnd) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  constexpr std::size_t all = 4 * 8 * 8;
  for (const std::string endless :
       {"for (;;) x += 1.0;", "while (true) { x += 1.0; }", "do x += 1.0; while (x > 0.0);",
        "while (x < 1.0) while (x < 1.0) x *= 0.5;",
        "for (int i = 0; i < 200; ++i) for (int k = 0; k < 200; ++k) x += 0.1;",
        "for (int i = 0; i < 10; --i) { if (x > 5.0) continue; else x += 1.0; }"}) {
    EXPECT_EQ(endlessIn(scene, endless), all) << endless;
  }
  EXPECT_EQ(endlessIn(scene, "while (pixel.texel.x < 8.0) x += 1.0;"), all / 2);
  for (const std::string ends :
       {"x = 2.0;", "for (int i = 0; i < 100; ++i) for (int k = 0; k < 100; ++k) x += 0.1;",
        "for (;;) { x += 1.0; if (x > 9.0) break; }", "do { x += 1.0; } while (x < 100.0);",
        "for (int i = 0; i < 9; ++i) if (x > 5.0) x += 2.0; else x += 1.0;",
        "while (x++ < 30000.0);"}) {
    EXPECT_EQ(endlessIn(scene, ends), 0U) << ends;
  }
}

TEST(LoopCheck, RefusesAPassAndABakeThatDoNotEnd) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  const auto refusal = [&](const Method& method) {
    try {
      (void)endlessOf(scene, method);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string answer = "bool isShadowed(Pixel pixel, LocalLight light) { return false; }\n";
  const std::string pass =
      "[[pass]]\nname = \"one\"\nkind = \"light\"\nclear = 1\nbits = 8\n"
      "[parameters.depth_side]\ndefault = 16\nminimum = 16\nmaximum = 32\n"
      "type = \"int\"\n";
  const std::string ends = "float passOne(Pixel pixel, float depth) { return 1.0; }\n";
  EXPECT_EQ(refusal(methodOfText(pass, ends + answer)), "") << "what is cleared is no fault";
  EXPECT_THAT(refusal(methodOfText(pass,
                                   "float passOne(Pixel pixel, float depth) {\n"
                                   "  float x = depth;\n  while (x >= 0.0) x += 1.0;\n"
                                   "  return x;\n}\n" +
                                       answer)),
              HasSubstr("the loops of its pass `one` turn 32768 times or more at "));
  const Method bakes = methodOfText("[bakes.sky]\nsize = [4, 3]\n",
                                    "float bakeSky(vec2 texel) {\n  float x = 1.0;\n"
                                    "  while (x > 0.0 && texel.x < 8.0) x += 1.0;\n"
                                    "  return 1.0;\n}\n" +
                                        answer);
  const BakePass baking(shaderFolder(), bakes, scene.relief.field.wrap(), TableFilter::exact, {},
                        true);
  try {
    (void)baking.bake(scene.bakeScene(), {});
    ADD_FAILURE() << "it was baked";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("bake `sky`: its loops turn 32768 times or more at 6 of 12 "
                                        "texels"));
  }
}

TEST(LoopCheck, TheProgramsOwnMethodsAllEndAndAnswerWithNumbers) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  const RenderView view = atlasView(scene.surface, 8);
  const Vec3 light = lightToward(20, 30);
  std::size_t looping = 0;
  for (const std::string& name : methodNames(shaderFolder())) {
    const Method method = readMethod(methodFile(shaderFolder(), name));
    const bool isDrawnHere =
        !method.needsCamera() && method.mesh == DrawnMesh::base && !method.tables.surfaceAngles;
    if (!isDrawnHere) continue;
    EXPECT_EQ(scene.answers(method, view, {light}).front().faulty.size(), 0U) << name;
    EXPECT_EQ(scene.shares(method, view, light, radians(2)).faulty.size(), 0U) << name;
    if (!hasLoops(method)) continue;
    EXPECT_EQ(endlessOf(scene, method).size(), 0U) << name;
    EXPECT_EQ(endlessOf(scene, method, radians(2)).size(), 0U) << name;
    ++looping;
  }
  EXPECT_GT(looping, 5U);
}

}  // namespace
}  // namespace gnomon::render
