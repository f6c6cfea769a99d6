#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "common/vec.h"
#include "horizon/horizon_bake.h"
#include "horizon/reference.h"
#include "truth/truth_scenes.h"

// The corrected horizons against the circle drawn with compass and ruler, and against the published
// text in its own letters.

namespace gnomon::horizon {
namespace {

using test::randomRelief;
using test::stepRelief;

constexpr TableShape shape{5, 4, 6, relief::Wrap::repeat};

std::vector<float> entries(const TableShape& of) {
  std::mt19937 random(3);
  std::vector<float> values(static_cast<std::size_t>(of.width * of.height * of.layers));
  for (float& value : values) value = static_cast<float>(random() % 1000) / 100;
  return values;
}

double entry(const std::vector<float>& values, int x, int y, int m) {
  return values[static_cast<std::size_t>((m * shape.height + y) * shape.width + x)];
}

TEST(FilteredTable, IsTheEntryAtATexelCentreInItsAzimuth) {
  const std::vector<float> values = entries(shape);
  const StoredTable table = storeTable(values, TableBits::thirtyTwo);
  for (int m = 0; m < shape.layers; ++m) {
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        const Vec2 centre(x + 0.5, y + 0.5);
        const double azimuth = 2 * pi * m / shape.layers;
        EXPECT_NEAR(filteredValue(table, shape, centre, azimuth), entry(values, x, y, m), 1e-12);
        // A turn and a whole map on.
        EXPECT_NEAR(filteredValue(table, shape, centre - Vec2(10, 8), azimuth - 4 * pi),
                    entry(values, x, y, m), 1e-12);
      }
    }
  }
}

/// Trilinear: a function that is linear in x, y and azimuth comes back.
TEST(FilteredTable, IsLinearInAllThreeAxes) {
  const TableShape clamped{8, 8, 8, relief::Wrap::clamp};
  std::vector<float> values;
  for (int m = 0; m < 8; ++m) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) values.push_back(static_cast<float>(2 * x - y + 4 * m));
    }
  }
  const StoredTable table = storeTable(values, TableBits::thirtyTwo);
  for (const Vec2 at : {Vec2(0.5, 0.5), Vec2(3.3, 6.1), Vec2(7.5, 2.9)}) {
    for (const double place : {0.0, 2.25, 6.999}) {
      EXPECT_NEAR(filteredValue(table, clamped, at, 2 * pi * place / 8),
                  2 * (at.x - 0.5) - (at.y - 0.5) + 4 * place, 1e-9);
    }
    // From the last azimuth on, it goes back to the first.
    EXPECT_NEAR(filteredValue(table, clamped, at, 2 * pi * 7.5 / 8),
                2 * (at.x - 0.5) - (at.y - 0.5) + 4 * 3.5, 1e-9);
  }
  EXPECT_NEAR(filteredValue(table, clamped, Vec2(-9, 99), 0), -7, 1e-9);
}

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
