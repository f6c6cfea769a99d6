#include "horizon/reference/height_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "horizon/horizon_bake.h"
#include "truth/truth_scenes.h"

namespace gnomon::horizon {
namespace {

using test::randomRelief;
using test::stepRelief;

Vec2 directionOf(double degrees) {
  return {std::cos(radians(degrees)), std::sin(radians(degrees))};
}

TEST(HeightProfile, IsTheReliefAtItsPointsAndAParabolaBetween) {
  for (const relief::Wrap wrap : {relief::Wrap::repeat, relief::Wrap::clamp}) {
    const relief::HeightField field(24, 20, randomRelief(24, 20, 5, 7).field.texels(), wrap);
    for (const double azimuth : {0.0, 17.0, 90.0, 131.0, 225.0, 300.0}) {
      for (const Vec2 origin : {Vec2(4.5, 7.5), Vec2(3.2, 9.9), Vec2(0.1, 19.7), Vec2(11.5, 2.2)}) {
        const Vec2 e = directionOf(azimuth);
        const HeightProfile profile = heightProfile(field, origin, e, 30.4, 6.3);
        const auto height = [&](double r) { return field.at(origin + r * e); };
        ASSERT_GT(profile.points.size(), 30U);
        EXPECT_EQ(profile.points.front().distance, -6.3);
        EXPECT_EQ(profile.points.back().distance, 30.4);
        for (std::size_t k = 0; k < profile.points.size(); ++k) {
          const ProfilePoint& at = profile.points[k];
          EXPECT_NEAR(at.height, height(at.distance), 1e-7);
          if (k == 0) continue;
          // Third differences of a parabola vanish: no lattice line has been missed.
          const double near = profile.points[k - 1].distance;
          const double step = (at.distance - near) / 3;
          ASSERT_GT(step, 0);
          const double third = height(near + 3 * step) - 3 * height(near + 2 * step) +
                               3 * height(near + step) - height(near);
          EXPECT_NEAR(third, 0, 1e-9);
        }
      }
    }
  }
}

/// What the section shows is what the tables hold: at texel centres, in their azimuths.
TEST(FlatHorizon, IsThatOfTheBakeAtTexelCentres) {
  const std::vector<float> heights = randomRelief(20, 12, 3, 5).field.texels();
  const relief::Border all{true, true};
  const relief::Border above{false, true};
  for (const relief::HeightField& field :
       {relief::HeightField(20, 12, heights, relief::Wrap::repeat),
        relief::HeightField(20, 12, heights, relief::Wrap::clamp),
        relief::HeightField(20, 12, heights, relief::Wrap::clamp, all),
        relief::HeightField(20, 12, heights, relief::Wrap::repeat, all),
        relief::HeightField(20, 12, heights, relief::Wrap::repeat, above)}) {
    const BakeSettings settings{12, 17.3};
    const HorizonTables tables = bakeHorizons(field, settings);
    int attached = 0;
    for (int m = 0; m < settings.azimuths; ++m) {
      for (int y = 0; y < field.height(); ++y) {
        for (int x = 0; x < field.width(); ++x) {
          const auto entry = static_cast<std::size_t>((m * field.height() + y) * field.width() + x);
          const FlatHorizon found =
              flatHorizon(field, Vec2(x + 0.5, y + 0.5), azimuthDirection(m, settings.azimuths),
                          settings.radiusTexels);
          EXPECT_NEAR(found.slope, tables.horizon[entry], 1e-5);
          EXPECT_NEAR(found.distance, tables.distance[entry], 1e-4);
          attached += found.distance == 0 ? 1 : 0;
        }
      }
    }
    EXPECT_GT(attached, 0);
    EXPECT_LT(attached, 12 * 20 * 12);
  }
}

/// Nothing past a border is seen from anywhere in the map, also from the half texel before it.
TEST(FlatHorizon, EndsAtABorder) {
  const relief::HeightField field = randomRelief(24, 20, 4, 3).field.withBorder({true, true});
  for (const double azimuth : {0.0, 33.0, 97.0, 180.0, 271.0}) {
    for (const Vec2 origin : {Vec2(4.5, 7.5), Vec2(0.1, 19.7), Vec2(23.9, 0.2)}) {
      const Vec2 e = directionOf(azimuth);
      const double known = field.knownLength(origin, e);
      const FlatHorizon ended = flatHorizon(field, origin, e, 60);
      const FlatHorizon open = flatHorizon(field.withBorder({}), origin, e, known);
      EXPECT_EQ(ended.slope, open.slope);
      EXPECT_EQ(ended.distance, open.distance);
      EXPECT_LE(ended.distance, known);
    }
  }
  EXPECT_GT(flatHorizon(field.withBorder({}), Vec2(23.5, 7.5), Vec2(1, 0), 20).slope,
            flatHorizon(field, Vec2(23.5, 7.5), Vec2(1, 0), 20).slope);
}

/// Anywhere, against dense sampling.
TEST(FlatHorizon, IsTheHighestSlopeAlongTheRay) {
  const relief::HeightField field = randomRelief(24, 20, 4, 3).field;
  int inside = 0;
  for (const double azimuth : {0.0, 33.0, 45.0, 97.0, 180.0, 200.0, 271.0, 315.0}) {
    for (const Vec2 origin : {Vec2(4.5, 7.5), Vec2(3.2, 9.9), Vec2(0.1, 19.7), Vec2(7.501, 2.499),
                              Vec2(-130.3, 1000.25)}) {
      const Vec2 e = directionOf(azimuth);
      const double radius = 15.2;
      const FlatHorizon found = flatHorizon(field, origin, e, radius);
      const double start = field.at(origin);
      const auto slope = [&](double r) { return (field.at(origin + r * e) - start) / r; };
      double highest = slope(1e-6);
      double at = 0;
      for (double r = 1e-3; r <= radius; r += 1e-3) {
        if (slope(r) > highest) at = r;
        highest = std::max(highest, slope(r));
      }
      EXPECT_NEAR(found.slope, highest, 2e-3) << azimuth << " " << origin.x;
      EXPECT_NEAR(found.distance, at, 5e-3) << azimuth << " " << origin.x;
      EXPECT_GE(found.slope, highest - 1e-5);
      const Vec2 there = glm::fract(origin + found.distance * e - 0.5);
      const double nearest = std::min({there.x, 1 - there.x, there.y, 1 - there.y});
      inside += found.distance > 0 && nearest > 1e-3 ? 1 : 0;
    }
  }
  // Also those that lie on no lattice line: the parabola's own extremum.
  EXPECT_GT(inside, 0);
}

/// A wall 6 high whose top begins at x = 28.5: from x the horizon is 6 / (28.5 - x).
TEST(FlatHorizon, OfAWallIsItsHeightOverItsDistance) {
  const relief::HeightField field =
      stepRelief(64, 16, 6, [](int i, int) { return i >= 28 && i < 32; }).field;
  for (const double x : {4.0, 10.5, 20.3}) {
    for (const double azimuth : {0.0, 25.0, -40.0}) {
      const double far = (28.5 - x) / std::cos(radians(azimuth));
      const FlatHorizon found = flatHorizon(field, Vec2(x, 8.1), directionOf(azimuth), 40);
      EXPECT_NEAR(found.slope, 6 / far, 1e-12);
      EXPECT_NEAR(found.distance, far, 1e-9);
    }
  }
  const FlatHorizon behind = flatHorizon(field, Vec2(40, 8.1), Vec2(1, 0), 20);
  EXPECT_EQ(behind.slope, 0);
  EXPECT_EQ(behind.distance, 0);
}

TEST(HeightProfile, TakesPositionsThatNoIntegerHolds) {
  const relief::HeightField repeated = randomRelief(16, 16, 2, 1).field;
  const relief::HeightField clamped(16, 16, repeated.texels(), relief::Wrap::clamp);
  for (const Vec2 origin : {Vec2(1e12, -1e12), Vec2(-3e15, 4e15)}) {
    for (const relief::HeightField* field : {&repeated, &clamped}) {
      const FlatHorizon found = flatHorizon(*field, origin, Vec2(1, 0), 12);
      EXPECT_TRUE(std::isfinite(found.slope));
      EXPECT_GT(heightProfile(*field, origin, Vec2(0, 1), 12, 3).points.size(), 10U);
    }
    // Far off a corner of the map all is flat.
    EXPECT_EQ(flatHorizon(clamped, origin, Vec2(0.6, 0.8), 12).distance, 0);
  }
}

}  // namespace
}  // namespace gnomon::horizon
