#include "common/degrees.h"

#include <gtest/gtest.h>

#include <random>

#include "common/vec.h"

namespace gnomon {
namespace {

TEST(Degrees, AreKeptToTheBit) {
  for (const double degrees : {0.0, 24.0, 165.0, -90.0, 0.1, 12.345, 359.999, 1e-7, 47.0 / 3}) {
    EXPECT_EQ(radians(degreesOf(radians(degrees))), radians(degrees)) << degrees;
  }
  EXPECT_EQ(degreesOf(radians(24)), 24);
  EXPECT_EQ(degreesOf(radians(0.1)), 0.1);
  EXPECT_EQ(degreesOf(radians(12.345)), 12.345);
  std::mt19937 random(1);
  for (int k = 0; k < 10000; ++k) {
    const double angle = radians(static_cast<double>(random()) / 1e7);
    ASSERT_EQ(radians(degreesOf(angle)), angle);
  }
}

}  // namespace
}  // namespace gnomon
