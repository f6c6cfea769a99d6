#include "common/light.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(Light, LiesWhereItsAnglesSay) {
  EXPECT_NEAR(glm::length(makeLight({90, 0}).direction - Vec3(0, 1, 0)), 0, 1e-15);
  EXPECT_NEAR(glm::length(makeLight({30, 90}).direction - Vec3(0, 0, 1)), 0, 1e-15);
  EXPECT_EQ(makeLight({0, 45, 0.5}).radius, radians(0.5));
}

TEST(Light, IsNamedByItsAnglesIfItHasNoName) {
  EXPECT_EQ(makeLight({165, 24}).name, "elevation 24° azimuth 165°");
  EXPECT_EQ(makeLight({165, 24, 0.266}).name, "elevation 24° azimuth 165° radius 0.266°");
  EXPECT_EQ(makeLight({165, 24}, "evening").name, "evening");
}

}  // namespace
}  // namespace gnomon
