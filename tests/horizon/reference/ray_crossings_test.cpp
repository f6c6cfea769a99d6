#include "horizon/reference/ray_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::horizon {
namespace {

TEST(AzimuthDirection, IsExactOnAxesAndDiagonals) {
  for (const int azimuths : {4, 8, 12, 32, 1024}) {
    EXPECT_EQ(azimuthDirection(0, azimuths), Vec2(1, 0));
    EXPECT_EQ(azimuthDirection(azimuths / 4, azimuths), Vec2(0, 1));
    EXPECT_EQ(azimuthDirection(azimuths / 2, azimuths), Vec2(-1, 0));
    EXPECT_EQ(azimuthDirection(3 * azimuths / 4, azimuths), Vec2(0, -1));
    if (azimuths % 8 != 0) continue;
    const Vec2 diagonal = azimuthDirection(5 * azimuths / 8, azimuths);
    EXPECT_EQ(diagonal.x, diagonal.y);
    EXPECT_LT(diagonal.x, 0);
  }
}

TEST(AzimuthDirection, IsTheUnitVectorOfTheAngle) {
  for (const int azimuths : {1, 2, 3, 5, 7, 8, 31, 36, 360}) {
    for (int m = 0; m < azimuths; ++m) {
      const Vec2 e = azimuthDirection(m, azimuths);
      const double angle = 2 * pi * m / azimuths;
      EXPECT_NEAR(e.x, std::cos(angle), 2e-15);
      EXPECT_NEAR(e.y, std::sin(angle), 2e-15);
    }
  }
}

void expectInOrder(const RayCrossings& ray, Vec2 offset) {
  double r = 0;
  for (const Crossing& c : ray.crossings) {
    EXPECT_EQ(c.enter, r);
    EXPECT_GT(c.leave, c.enter);
    r = c.leave;
    const Vec2 from(c.from.x, c.from.y);
    const Vec2 to(c.to.x, c.to.y);
    const Vec2 off = from + c.share * (to - from) - offset - c.leave * ray.direction;
    EXPECT_LT(glm::length(off), 1e-12);
    // Nothing is crossed between: the middle of the stretch is inside the cell named.
    const Vec2 middle = offset + 0.5 * (c.enter + c.leave) * ray.direction;
    EXPECT_EQ(c.cell.x, std::floor(middle.x));
    EXPECT_EQ(c.cell.y, std::floor(middle.y));
  }
  EXPECT_EQ(ray.lastEnter, r);
  EXPECT_LE(r, ray.radius);
  const Vec2 end = offset + 0.5 * (r + ray.radius) * ray.direction;
  EXPECT_EQ(ray.lastCell.x, std::floor(end.x));
  EXPECT_EQ(ray.lastCell.y, std::floor(end.y));
}

TEST(RayCrossings, LieOnLatticeLinesInOrderAndMissNone) {
  for (const int azimuths : {4, 7, 8, 24}) {
    for (int m = 0; m < azimuths; ++m) {
      const Vec2 e = azimuthDirection(m, azimuths);
      expectInOrder(cutRay(e, 25.3), Vec2(0));
    }
  }
}

TEST(RayCrossings, FromWithinACellLieOnLatticeLinesToo) {
  for (const Vec2 offset : {Vec2(0.3, 0.8), Vec2(0.5, 0), Vec2(0, 0.01), Vec2(0.99, 0.5)}) {
    for (int m = 0; m < 11; ++m) {
      const RayCrossings ray = cutRay(azimuthDirection(m, 11), 9.7, offset);
      EXPECT_GT(ray.crossings.size(), 8U);
      expectInOrder(ray, offset);
    }
  }
}

TEST(RayCrossings, CountNodesOnceOnADiagonal) {
  const RayCrossings ray = cutRay(azimuthDirection(3, 8), 10);
  ASSERT_EQ(ray.crossings.size(), 7U);  // 7 √2 < 10 < 8 √2
  for (std::size_t k = 0; k < ray.crossings.size(); ++k) {
    const auto n = static_cast<int>(k) + 1;
    EXPECT_EQ(ray.crossings[k].from.x, -n);
    EXPECT_EQ(ray.crossings[k].from.y, n);
    EXPECT_EQ(ray.crossings[k].share, 0);
  }
}

TEST(RayCrossings, IncludeALineMetAtTheVeryEnd) {
  const RayCrossings ray = cutRay({0, -1}, 5);
  EXPECT_EQ(ray.crossings.size(), 5U);
  EXPECT_EQ(ray.lastEnter, 5);
  EXPECT_TRUE(cutRay({1, 0}, 0.9).crossings.empty());
}

}  // namespace
}  // namespace gnomon::horizon
