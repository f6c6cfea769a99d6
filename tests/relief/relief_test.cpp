#include "relief/relief.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::relief {
namespace {

surface::TexelFrame frameWith(const Vec3& px, const Vec3& py) {
  return {{1, 2, 3}, glm::normalize(glm::cross(px, py)), px, py, {1.5, 0.5}, true};
}

HeightField twoTexels() {
  return {2, 1, {0, 4}, Wrap::clamp};
}

TEST(Relief, AHeightInWorldUnitsIsALength) {
  const surface::TexelFrame frame = frameWith({0.1, 0, 0}, {0, 0.3, 0});
  EXPECT_EQ(worldPerHeight(HeightSpace::world, frame), 1);
  const Relief relief{twoTexels(), HeightSpace::world, {1, 1}};
  EXPECT_EQ(displaced(relief, frame), Vec3(1, 2, 7));
}

TEST(Relief, AHeightInTexelsScalesWithTheRootOfATexelsArea) {
  // A texel of 4 by 9 world units has area 36, sheared or not: one height unit is 6.
  for (const double shear : {0.0, 5.0}) {
    const surface::TexelFrame frame = frameWith({4, 0, 0}, {shear, 9, 0});
    EXPECT_DOUBLE_EQ(worldPerHeight(HeightSpace::texture, frame), 6);
    const Relief relief{twoTexels(), HeightSpace::texture, {1, 1}};
    EXPECT_DOUBLE_EQ(displaced(relief, frame).z, 3 + 6 * 4);
  }
}

TEST(Relief, ScalingTheSurfaceScalesTextureHeights) {
  const surface::TexelFrame one = frameWith({1, 0.2, 0}, {0, 1, 0.5});
  const surface::TexelFrame ten = frameWith({10, 2, 0}, {0, 10, 5});
  EXPECT_DOUBLE_EQ(worldPerHeight(HeightSpace::texture, ten),
                   10 * worldPerHeight(HeightSpace::texture, one));
}

TEST(Relief, AnUndefinedFrameIsNotDisplaced) {
  surface::TexelFrame frame{};
  frame.position = {1, 2, 3};
  frame.texel = {std::nan(""), 0};
  for (const HeightSpace space : {HeightSpace::world, HeightSpace::texture}) {
    EXPECT_EQ(displaced({twoTexels(), space, {1, 1}}, frame), Vec3(1, 2, 3));
  }
}

TEST(Relief, RepeatsMultiplyTheTexels) {
  const Relief relief{twoTexels(), HeightSpace::world, {3, 5}};
  EXPECT_EQ(relief.texelsPerUv(), Vec2(6, 5));
}

}  // namespace
}  // namespace gnomon::relief
