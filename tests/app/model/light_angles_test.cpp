#include "model/light_angles.h"

#include <gtest/gtest.h>

#include <random>

#include "common/error.h"

namespace gnomon::app {
namespace {

TEST(LightDrag, KeepsTheLightsDisc) {
  for (const double degrees : {0.0, 0.266, 0.007, 3.0, 9.999}) {
    EXPECT_EQ(dragged({165, 24, degrees}, 7, -3).radius, degrees);
  }
}

TEST(LightDrag, AndBackReturns) {
  std::mt19937 random(2);
  const auto change = [&] { return 40 * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
  for (int k = 0; k < 1000; ++k) {
    const LightAngles start{165.25, 24};
    const double azimuth = 10 * change();
    const double elevation = change();
    const LightAngles there = dragged(start, azimuth, elevation);
    ASSERT_GE(there.azimuth, 0);
    ASSERT_LT(there.azimuth, 360);
    const LightAngles back = dragged(there, -azimuth, -elevation);
    EXPECT_EQ(back.azimuth, start.azimuth) << azimuth;
    EXPECT_EQ(back.elevation, start.elevation) << elevation;
  }
}

TEST(LightDrag, WrapsRoundAndEndsAtThePoles) {
  EXPECT_EQ(dragged({350, 24}, 20, 0).azimuth, 10);
  EXPECT_EQ(dragged({10, 24}, -20, 0).azimuth, 350);
  EXPECT_EQ(dragged({10, 24}, -10, 0).azimuth, 0);
  EXPECT_EQ(dragged({359.9999, 24}, 0, 0).azimuth, 0);
  EXPECT_EQ(dragged({10, 24}, 0, 100).elevation, 90);
  EXPECT_EQ(dragged({10, 24}, 0, -200).elevation, -90);
}

TEST(LightPath, GoesEvenlyFromItsStartToItsEnd) {
  const LightPath path{350, 10, 380, 70, 7};
  const double azimuths[] = {350, 355, 0, 5, 10, 15, 20};
  for (int frame = 0; frame < path.frames; ++frame) {
    const LightAngles light = lightAt(path, frame, 0.266);
    EXPECT_EQ(light.azimuth, azimuths[frame]);
    EXPECT_EQ(light.elevation, 10 + 10 * frame);
    EXPECT_EQ(light.radius, 0.266);
  }
  EXPECT_EQ(lightAt({30, 20, 90, 60, 1}, 0, 0), (LightAngles{30, 20, 0})) << "a path of one frame";
}

/// A film of it repeats: the step from the last frame to the first is like all others.
TEST(LightPath, OnceAroundLeavesOutTheFrameThatWouldRepeatTheFirst) {
  const LightPath path = parsePath("around", {165, 24, 0}, 36);
  for (int frame = 0; frame < path.frames; ++frame) {
    const LightAngles next = lightAt(path, (frame + 1) % path.frames, 0);
    EXPECT_EQ(next, dragged(lightAt(path, frame, 0), 10, 0));
  }
  // So does one of two turns the other way.
  EXPECT_EQ(lightAt({165, 24, -555, 24, 36}, 35, 0), (LightAngles{185, 24, 0}));
  EXPECT_EQ(lightAt({165, 24, 525, 30, 36}, 35, 0), (LightAngles{165, 30, 0}))
      << "a spiral does not end where it began";
  EXPECT_EQ(lightAt({165, 24, 165, 24, 36}, 35, 0), (LightAngles{165, 24, 0}));
}

TEST(LightPath, IsReadFromText) {
  EXPECT_EQ(parsePath("165,24,-20.5,60", {}, 9), (LightPath{165, 24, -20.5, 60, 9}));
  EXPECT_EQ(parsePath("around", {200, 30, 1}, 9), (LightPath{200, 30, 560, 30, 9}));
  for (const char* text : {"", "round", "1,2,3", "1,2,3,4,5", "1,2,3,", "1;2;3;4", "1,2,3,x",
                           "0,91,0,0", "0,0,0,-90.5", "0,0,4000,0", "0,0,nan,0", "0,0,inf,0"}) {
    EXPECT_THROW((void)parsePath(text, {}, 9), UsageError) << text;
  }
}

}  // namespace
}  // namespace gnomon::app
