#include "model/light_angles.h"

#include <gtest/gtest.h>

#include <random>

namespace gnomon::app {
namespace {

TEST(LightAngles, AreThoseOfTheLight) {
  const study::LightSpec light{"evening", radians(165), radians(24)};
  const study::LightSpec same = lightSpec(lightAngles(light));
  EXPECT_EQ(same.azimuth, light.azimuth);
  EXPECT_EQ(same.elevation, light.elevation);
  EXPECT_EQ(same.name, "elevation 24° azimuth 165°");
}

TEST(LightAngles, KeepTheLightsDisc) {
  for (const double degrees : {0.0, study::sunRadius, 0.007, 3.0, 9.999}) {
    const study::LightSpec light{"", radians(165), radians(24), radians(degrees)};
    const LightAngles angles = lightAngles(light);
    EXPECT_EQ(angles.radius, degrees);
    EXPECT_EQ(lightSpec(angles).radius, light.radius);
    EXPECT_EQ(dragged(angles, 7, -3).radius, degrees);
  }
  EXPECT_EQ(lightSpec({165, 24, study::sunRadius}).name,
            "elevation 24° azimuth 165° radius 0.266°");
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

}  // namespace
}  // namespace gnomon::app
