#include "render/frame_timer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "render/gl_context.h"

namespace gnomon {
namespace {

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

TEST(FrameTimes, AreTheMedianOfTheFramesAfterTheFirst) {
  const GlContext gl;
  int drawn = 0;
  // The first frame and one of the others are slow: neither is the median of five.
  const auto draw = [&drawn] {
    std::this_thread::sleep_for(std::chrono::milliseconds(drawn == 0 || drawn == 2 ? 60 : 5));
    ++drawn;
  };
  const double median = medianFrameMilliseconds(draw, 5, FrameClock::wall);
  EXPECT_EQ(drawn, 6);
  EXPECT_GE(median, 5);
  EXPECT_LT(median, 60);
}

TEST(FrameTimes, OfSlowFramesStopEarly) {
  const GlContext gl;
  int drawn = 0;
  const auto draw = [&drawn] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    ++drawn;
  };
  EXPECT_GE(medianFrameMilliseconds(draw, 25, FrameClock::wall), 200);
  EXPECT_EQ(drawn, 3);
}

/// What a query answers is the driver's; that it answers without an error, for every frame, is
/// ours.
TEST(FrameTimes, ByTimerQueriesAreNotNegative) {
  const GlContext gl;
  int drawn = 0;
  EXPECT_GE(medianFrameMilliseconds([&drawn] { ++drawn; }, 3, FrameClock::query), 0);
  EXPECT_EQ(drawn, 4);
}

}  // namespace
}  // namespace gnomon
