#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "render/frame_timer.h"
#include "render/gl_context.h"
#include "render/method_text.h"
#include "render/passes/texel_counter.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::RenderScene;

TEST(FrameClock, OfSoftwareRenderersIsTheWallClock) {
  for (const char* name : {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "Google SwiftShader",
                           "Software Rasterizer"}) {
    EXPECT_EQ(frameClockOf(name), FrameClock::wall) << name;
  }
}

TEST(FrameClock, OfGpusIsTheTimerQuery) {
  for (const char* name : {"NVIDIA H200/PCIe/SSE2", "Mesa Intel(R) UHD Graphics 620 (KBL GT2)",
                           "AMD Radeon RX 6800 (navi21, LLVM 15.0.6, DRM 3.49)"}) {
    EXPECT_EQ(frameClockOf(name), FrameClock::query) << name;
  }
}

TEST(FrameTimes, OfSlowFramesStopEarly) {
  const GlContext gl;
  int drawn = 0;
  const auto draw = [&drawn] {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    ++drawn;
  };
  EXPECT_GE(medianFrameMilliseconds(draw, {}, {}, FrameClock::wall), 150);
  EXPECT_EQ(drawn, 2);
}

/// Hands out times one by one, and again from the first.
class Times {
 public:
  explicit Times(std::vector<double> milliseconds) : milliseconds_(std::move(milliseconds)) {}
  double operator()() { return milliseconds_[taken_++ % milliseconds_.size()]; }
  [[nodiscard]] std::size_t taken() const { return taken_; }
  /// Without the one that warms up.
  [[nodiscard]] std::size_t counted() const { return taken_ - 1; }

 private:
  std::vector<double> milliseconds_;
  std::size_t taken_ = 0;
};

double medianOf(Times& times, FrameLimits limits = {}) {
  return medianMilliseconds([&times] { return times(); }, limits, {});
}

TEST(FrameTimes, AreTheMedianOfTheFramesAfterTheFirst) {
  // The first frame and one of the others are slow: neither is the median of five.
  Times times({60, 5, 60, 4, 6, 5.5});
  EXPECT_EQ(medianOf(times, {5, 100}), 5.5);
  EXPECT_EQ(times.counted(), 5U);
}

TEST(FrameTimes, EndOnceTheMedianIsKnown) {
  Times steady({10});
  EXPECT_EQ(medianOf(steady), 10);
  EXPECT_EQ(steady.counted(), 9U);
  // Of nine times the second smallest and the second largest hold the median with 96.1 %: one
  // outlier at either end says nothing, two do.
  Times outliers({9, 1, 0.5, 1, 1, 1, 1, 1, 2, 1});
  EXPECT_EQ(medianOf(outliers), 1);
  EXPECT_EQ(outliers.counted(), 9U);
  Times more({9, 2, 1, 1, 1, 2, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
  EXPECT_EQ(medianOf(more), 1);
  EXPECT_EQ(more.counted(), 12U);  // where it is the third largest: 96.1 % too
}

TEST(FrameTimes, GoOnWhileTheMedianIsNotKnownToTwoPercent) {
  Times within({1.0, 1.019});
  medianOf(within);
  EXPECT_EQ(within.counted(), 9U);
  Times apart({1.0, 1.03});
  medianOf(apart);
  EXPECT_EQ(apart.counted(), 25U);
  Times few({10});
  medianOf(few, {5, 100});
  EXPECT_EQ(few.counted(), 5U);
  Times slow({60});
  medianOf(slow);
  EXPECT_EQ(slow.counted(), 2U);
}

TEST(FrameTimes, EndAfterTheirTimeWithOneFrameAtLeast) {
  Times quick({1.0, 1.03});
  medianOf(quick, {25, 15});
  EXPECT_EQ(quick.counted(), 15U);
  Times longer({10});
  medianOf(longer, {25, 15});
  EXPECT_EQ(longer.counted(), 2U);
  Times another({11});  // would lead from 4 before the end to 7 after it
  medianOf(another, {25, 15});
  EXPECT_EQ(another.counted(), 1U);
  Times slow({150});
  medianOf(slow, {25, 15});
  EXPECT_EQ(slow.counted(), 1U);
}

TEST(FrameTimes, OfWarmFramesCountTheFirst) {
  Times times({30, 10, 20});
  EXPECT_EQ(medianMilliseconds([&times] { return times(); }, {3, 100}, {true}), 20);
  EXPECT_EQ(times.taken(), 3U);
}

TEST(FrameTimes, CountOneThatWasTimedBefore) {
  Times times({10, 20});
  EXPECT_EQ(medianMilliseconds([&times] { return times(); }, {3, 100}, {true, 50}), 20);
  EXPECT_EQ(times.taken(), 2U);
  Times none({10});
  EXPECT_EQ(medianMilliseconds([&none] { return none(); }, {3, 100}, {true, 150}), 150);
  EXPECT_EQ(none.taken(), 0U);
}

/// What a query answers is the driver's; that it answers without an error, for every frame, is
/// ours.
TEST(FrameTimes, ByTimerQueriesAreNotNegative) {
  const GlContext gl;
  int drawn = 0;
  EXPECT_GE(medianFrameMilliseconds([&drawn] { ++drawn; }, {3, 100}, {}, FrameClock::query), 0);
  EXPECT_EQ(drawn, 4);
}

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
