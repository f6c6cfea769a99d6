// The corrected horizons against the circle drawn with compass and ruler, and against the published
// text in its own letters.

#include "horizon/reference/osculating_horizon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "common/vec.h"

namespace gnomon::horizon {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

/// κ of both signs, heights of both signs, horizons above and below; |γ| up to 1.4.
std::vector<HorizonLookups> lookups() {
  std::vector<HorizonLookups> all;
  for (const double curvature : {-0.02, -0.003, 1e-6, 0.003, 0.015, 0.1}) {
    for (const double height : {-1.5, 0.0, 4.0}) {
      for (const double slope : {-0.4, 0.0, 0.3, 1.2}) {
        for (const double reach : {0.01, 1.0, 6.0, 14.0}) {
          all.push_back({curvature, height, slope, reach});
        }
      }
    }
  }
  return all;
}

/// The circle of curvature κ through (0, 0) with its top there: the place at an arc length and a
/// height over it.
Vec2 onCircle(double curvature, double arc, double height) {
  const double radius = 1 / curvature;
  const Vec2 centre(0, -radius);
  return centre + (radius + height) * Vec2(std::sin(arc / radius), std::cos(arc / radius));
}

TEST(OsculatingHorizon, IsTheSlopeBetweenTwoPlacesOnTheCircle) {
  for (const HorizonLookups& at : lookups()) {
    const Vec2 eye = onCircle(at.curvature, 0, at.height);
    const Vec2 occluder = onCircle(at.curvature, at.arcLength, at.height + at.slope * at.arcLength);
    const double slope = (occluder.y - eye.y) / (occluder.x - eye.x);
    // 1/κ up to 1e6: the construction itself loses ten digits there.
    EXPECT_NEAR(osculatingHorizon(at), slope, at.curvature == 1e-6 ? 1e-6 : 1e-11)
        << at.curvature << " " << at.height << " " << at.slope << " " << at.arcLength;
  }
}

/// Lengths of Fig. 2: AB, BC and EA, with H = d tan β.
TEST(UnreducedHorizon, IsThePapersFigure) {
  for (const HorizonLookups& at : lookups()) {
    const double radius = 1 / at.curvature;
    const double angle = at.arcLength / radius;
    const double ca = 2 * (radius + at.height) * std::sin(angle / 2);
    const double bc = ca * std::cos(angle / 2);
    const double ab = ca * std::sin(angle / 2);
    const double ea = at.arcLength * at.slope * std::cos(angle);
    EXPECT_NEAR(unreducedHorizon(at), (ea - ab) / bc, 1e-9 * (1 + std::abs(at.slope)));
  }
}

/// The step from there to (2) drops terms of second order in γ and κh: halve both, and the
/// difference is a quarter.
TEST(SmallAngleHorizon, IsTheUnreducedOneToFirstOrder) {
  const auto difference = [](double scale) {
    const HorizonLookups at{0.01 * scale, 3, 0.5, 10};
    return std::abs(smallAngleHorizon(at) - unreducedHorizon(at));
  };
  ASSERT_GT(difference(0.1), 1e-7);
  EXPECT_NEAR(difference(0.1) / difference(0.05), 4, 0.1);
}

TEST(CorrectedHorizons, AreTheFlatOneOnAFlatSurface) {
  for (const double slope : {-0.3, 0.0, 0.8}) {
    for (const double reach : {0.0, 5.0, 1e4}) {
      const HorizonLookups at{0, 7, slope, reach};
      EXPECT_EQ(smallAngleHorizon(at), slope);
      EXPECT_EQ(unreducedHorizon(at), slope);
      EXPECT_EQ(osculatingHorizon(at), slope);
    }
  }
}

TEST(CorrectedHorizons, OfAnAttachedHorizonAreItsSlopeOverTheOuterCircle) {
  const HorizonLookups at{0.02, 5, 0.6, 0};
  EXPECT_DOUBLE_EQ(osculatingHorizon(at), 0.6 / 1.1);
  EXPECT_DOUBLE_EQ(unreducedHorizon(at), 0.6 / 1.1);
  EXPECT_DOUBLE_EQ(smallAngleHorizon(at), 0.6 * 0.9);
}

TEST(CorrectedHorizons, AreContinuousWhereAnglesVanish) {
  for (const auto& formula : {unreducedHorizon, osculatingHorizon}) {
    const double at = formula({1e-3, 2, 0.4, 0});
    for (const double reach : {1e-3, 1e-5, 1e-7}) {
      EXPECT_NEAR(formula({1e-3, 2, 0.4, reach}), at, 2e-3 * reach);
    }
  }
}

TEST(CorrectedHorizons, SayNothingPastAQuarterTurn) {
  for (const double curvature : {0.1, -0.1}) {
    const HorizonLookups within{curvature, 0, 0.2, 15.7};
    const HorizonLookups past{curvature, 0, 0.2, 15.8};
    EXPECT_TRUE(std::isfinite(osculatingHorizon(within)));
    EXPECT_TRUE(std::isfinite(unreducedHorizon(within)));
    EXPECT_EQ(osculatingHorizon(past), nothing);
    EXPECT_EQ(unreducedHorizon(past), nothing);
  }
}

/// The tangent from a height to the circle: it touches at the angle α with cos α = R / (R + h), and
/// dips by α.
TEST(BareHorizon, IsTheTangentToTheSphere) {
  for (const double radius : {1.0, 66.0, 1e5}) {
    for (const double height : {0.01, 2.0, 30.0}) {
      const double dip = std::acos(radius / (radius + height));
      EXPECT_NEAR(bareHorizon(1 / radius, height) / -std::tan(dip), 1, 1e-6);
    }
  }
  EXPECT_EQ(bareHorizon(0.01, 0), 0);
  EXPECT_EQ(bareHorizon(0.01, -3), 0);
  EXPECT_EQ(bareHorizon(0, 3), nothing);
  EXPECT_EQ(bareHorizon(-0.01, 3), nothing);
}

/// The tangent is the highest that anything on the bare sphere is seen.
TEST(BareHorizon, IsTheSupremumOverTheBareCircle) {
  const double curvature = 0.015;
  const double height = 8;
  double highest = nothing;
  for (double reach = 0.5; reach < 100; reach += 0.05) {
    highest = std::max(highest, osculatingHorizon({curvature, height, -height / reach, reach}));
  }
  EXPECT_NEAR(highest, bareHorizon(curvature, height), 1e-6);
}

}  // namespace
}  // namespace gnomon::horizon
