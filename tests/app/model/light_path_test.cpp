#include "model/light_path.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace gnomon::app {
namespace {

TEST(LightPath, GoesEvenlyFromItsStartToItsEnd) {
  const LightPath path{350, 10, 380, 70, 7};
  EXPECT_FALSE(isClosed(path));
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
  const LightPath path = turnFrom({165, 24, 0}, 36);
  EXPECT_TRUE(isClosed(path));
  for (int frame = 0; frame < path.frames; ++frame) {
    const LightAngles next = lightAt(path, (frame + 1) % path.frames, 0);
    EXPECT_EQ(next, dragged(lightAt(path, frame, 0), 10, 0));
  }
  EXPECT_FALSE(isClosed({165, 24, 525, 30, 36})) << "a spiral does not end where it began";
  EXPECT_FALSE(isClosed({165, 24, 165, 24, 36})) << "a light that stands still does not turn";
  EXPECT_TRUE(isClosed({165, 24, -555, 24, 36}));
}

TEST(LightPath, IsPlayedAtTheSpeedOfFilms) {
  const LightPath path{0, 0, 90, 0, 3};
  constexpr double frame = 1.0 / pathFramesPerSecond;
  EXPECT_EQ(frameAt(path, 0), 0);
  EXPECT_EQ(frameAt(path, 1.5 * frame), 1);
  EXPECT_EQ(frameAt(path, 2.9 * frame), 2);
  EXPECT_FALSE(frameAt(path, 3.1 * frame));
}

TEST(LightPath, EndsAtALightByTheShorterWay) {
  const LightPath start{350, 24, 999, 0, 5};
  EXPECT_EQ(withEnd(start, {10, 60, 0}), (LightPath{350, 24, 370, 60, 5}));
  EXPECT_EQ(withEnd(start, {330, 60, 0}), (LightPath{350, 24, 330, 60, 5}));
  EXPECT_EQ(withEnd({10, 24, 0, 0, 5}, {350, 24, 0}), (LightPath{10, 24, -10, 24, 5}));
}

TEST(LightPath, IsReadFromText) {
  EXPECT_EQ(parsePath("165,24,-20.5,60", {}, 9), (LightPath{165, 24, -20.5, 60, 9}));
  EXPECT_EQ(parsePath("around", {200, 30, 1}, 9), (LightPath{200, 30, 560, 30, 9}));
  for (const char* text : {"", "round", "1,2,3", "1,2,3,4,5", "1,2,3,", "1;2;3;4", "1,2,3,x",
                           "0,91,0,0", "0,0,0,-90.5", "0,0,4000,0", "0,0,nan,0", "0,0,inf,0"}) {
    EXPECT_THROW((void)parsePath(text, {}, 9), UsageError) << text;
  }
}

TEST(LightPath, IsSaidInWords) {
  EXPECT_EQ(pathText(turnFrom({165, 24, 0}, 9)), "once around, from azimuth 165° at elevation 24°");
  EXPECT_EQ(pathText({165, 24, 20, 60, 9}), "from azimuth 165°, elevation 24° to 20°, 60°");
}

}  // namespace
}  // namespace gnomon::app
