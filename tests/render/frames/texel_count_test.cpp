#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/gl_objects.h"
#include "render/method_text.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::lightToward;
using test::methodOfText;
using test::RenderScene;
using test::stepScene;

double texelsOf(const RenderScene& scene, const Method& method, double radius = 0,
                const std::map<std::string, double>& parameters = {},
                TableFilter filter = TableFilter::exact) {
  const relief::Wrap wrap = scene.relief.field.wrap();
  const MethodPass pass(shaderFolder(), method, wrap, filter, parameters);
  const TexelCounter counter(shaderFolder(), method, wrap, filter, parameters);
  const RenderView view = atlasView(scene.surface, 8);
  double texels = -1;
  scene.withInputs(method, parameters, [&](Drawing drawn, const GpuTables& gpu) {
    drawn.light.direction = lightToward(20, 30);
    drawn.light.radius = radius;
    texels = pass.frameCosts(view, drawn, gpu, {1, 100}, {}, FrameClock::wall, counter).texels;
  });
  return texels;
}

double texelsOf(const RenderScene& scene, const char* name) {
  return texelsOf(scene, readMethod(methodFile(shaderFolder(), name)));
}

const char* const loopOfTexels = R"(
bool isShadowed(Pixel pixel, LocalLight light) {
  float sum = 0.0;
  for (int i = 0; i < int(count); ++i) sum += texelFetch(heightMap, ivec2(i, 0), 0).r;
  return sum < 0.0;
}
vec3 shadingNormal(Pixel pixel) { return pixel.normal; }
)";

const char* const counted = R"(
tables = ["height"]
normal = "own"
[parameters.count]
default = 0
minimum = 0
maximum = 99
about = "texels"
)";

TEST(TexelCount, IsTheNumberOfFetches) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  const Method method = methodOfText(counted, loopOfTexels);
  for (const double count : {0.0, 1.0, 37.0}) {
    EXPECT_EQ(texelsOf(scene, method, 0, {{"count", count}}), count);
  }
}

TEST(TexelCount, IsAMeanOverSamples) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  // The atlas has as many samples on either side of the middle; only one side reads.
  const Method method = methodOfText("tables = [\"height\"]\nnormal = \"own\"", R"(
bool isShadowed(Pixel pixel, LocalLight light) {
  return pixel.texel.x < 8.0 && texelFetch(heightMap, ivec2(0), 0).r < 0.0;
}
vec3 shadingNormal(Pixel pixel) { return pixel.normal; }
)");
  EXPECT_EQ(texelsOf(scene, method), 0.5);
}

/// Linear in both axes of the map and in the azimuth: eight entries more than the shading's alone.
TEST(TexelCount, OfAFlatHorizonMapIsItsEightEntries) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  EXPECT_EQ(texelsOf(scene, "max-forsyth") - texelsOf(scene, "unshadowed"), 8);
}

TEST(TexelCount, OfADiscIsThatOfTheShare) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  const Method method = methodOfText("tables = [\"height\"]\nnormal = \"own\"", R"(
bool isShadowed(Pixel pixel, LocalLight light) {
  return texelFetch(heightMap, ivec2(0), 0).r < 0.0;
}
float visibility(Pixel pixel, LocalLight light) {
  return texelFetch(heightMap, ivec2(0), 0).r + texelFetch(heightMap, ivec2(1), 0).r;
}
vec3 shadingNormal(Pixel pixel) { return pixel.normal; }
)");
  EXPECT_EQ(texelsOf(scene, method), 1);
  EXPECT_EQ(texelsOf(scene, method, radians(1)), 2);
}

/// The filter of the GPU reads the same eight entries in one instruction; N' is read by a gather.
TEST(TexelCount, IsTheSameForTheFilterOfTheGpu) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  const Method method = readMethod(methodFile(shaderFolder(), "max-forsyth"));
  EXPECT_EQ(texelsOf(scene, method, 0, {}, TableFilter::hardware), texelsOf(scene, method));
  EXPECT_EQ(texelsOf(scene, "unshadowed"), 4);
}

/// The depth map of the frame before the count is the one that the count reads: a sample of it a
/// sample of the filter, and the four texels of N'.
TEST(TexelCount, ReadsWhatTheFramesPassesLeft) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  const Method method = methodOfText(R"(
passes = ["light-depth"]
normal = "own"
[parameters.depth_side]
default = 64
minimum = 16
maximum = 8192
)",
                                     R"(
bool isShadowed(Pixel pixel, LocalLight light) {
  vec3 place = lightMapPlace(pixel.position);
  float depth = lightDepthOf(ivec2(floor(place.xy)));
  // Read again where the depth map is right, and nowhere else.
  return abs(depth - place.z) < 0.05 && lightDepthOf(ivec2(floor(place.xy))) < 0.0;
}
vec3 shadingNormal(Pixel pixel) { return pixel.normal; }
)");
  EXPECT_EQ(texelsOf(scene, method), 2);
}

TEST(TexelCount, IsTheMeanOfAllPixelsThatHaveASample) {
  EXPECT_EQ(meanOfSamples({3, -1, 5, -1, -1}), 4);
  EXPECT_TRUE(std::isnan(meanOfSamples({-1, -1})));
  // More than are summed at once: 0, 1, ... and each third pixel without a sample.
  std::vector<float> texels;
  double sum = 0;
  double count = 0;
  for (int i = 0; i < 200'003; ++i) {
    const bool isSample = i % 3 != 0;
    texels.push_back(isSample ? static_cast<float>(i) : -1.0F);
    sum += isSample ? i : 0;
    count += isSample ? 1 : 0;
  }
  EXPECT_EQ(meanOfSamples(texels), sum / count);
}

TEST(SharedTargets, AreOneOfEachKindAndOfTheLastSize) {
  const GlContext gl;
  SharedTargets targets;
  const GLuint bits = targets.get(8, 4, {GL_R8UI}).framebuffer();
  EXPECT_EQ(targets.get(8, 4, {GL_R8UI}).framebuffer(), bits);
  EXPECT_NE(targets.get(8, 4, {GL_R32F}).framebuffer(), bits);
  const Target& other = targets.get(4, 8, {GL_R8UI});
  EXPECT_EQ(other.width(), 4);
  EXPECT_EQ(other.height(), 8);
}

/// What one method left in them, or one light, does not show through under the next.
TEST(SharedTargets, LeaveNothingForTheNextAnswer) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  const relief::Wrap wrap = scene.relief.field.wrap();
  const auto targets = std::make_shared<SharedTargets>();
  // From either side, so that a sample of one picture is background in the next.
  const auto viewFrom = [&](double x) {
    return cameraView(Camera{{x, 0, 60}, {0.6 * x, 0, 0}, {0, 1, 0}, 0.5, 48, 40}, scene.mesh);
  };
  const auto answersOf = [&](const char* test, const RenderView& view,
                             const std::shared_ptr<SharedTargets>& held) {
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
