#include "relief/solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"
#include "common/random_stream.h"
#include "support/error_messages.h"

namespace gnomon::relief {
namespace {
using ::testing::StartsWith;

std::vector<Vec3> somePoints(int count) {
  RandomStream random(1);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.unit() * 20 - 10, random.unit() * 20 - 10, random.unit() * 20 - 10);
  }
  return points;
}

TEST(Solid, EveryKindRunsFromAboutZeroToOne) {
  for (const SolidPattern& solid :
       {SolidPattern(SolidNoise{}), SolidPattern(SolidCells{}), SolidPattern(SolidRipples{})}) {
    const SolidFunction f = solidFunction(solid);
    double least = 1;
    double most = 0;
    for (const Vec3& p : somePoints(20000)) {
      least = std::min(least, f(p));
      most = std::max(most, f(p));
    }
    EXPECT_GE(least, 0) << solid.index();
    EXPECT_LT(least, 0.25) << solid.index();
    EXPECT_LE(most, 1) << solid.index();
    EXPECT_GT(most, 0.75) << solid.index();
  }
}

/// Continuous at the borders of its lattice, in value and slope; a half on lattice points.
TEST(Solid, NoiseIsSmooth) {
  const SolidFunction f = solidFunction(SolidNoise{2, 1, 0.5, 3});
  EXPECT_DOUBLE_EQ(f({0, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(f({-4, 2, 6}), 0.5);
  constexpr double e = 1e-5;
  for (int k = -5; k < 5; ++k) {
    const Vec3 p(2 * k, 0.7 * k, 0.3);
    const Vec3 step(e, 0, 0);
    const double before = (f(p) - f(p - step)) / e;
    const double after = (f(p + step) - f(p)) / e;
    EXPECT_NEAR(before, after, 1e-3) << k;
  }
  // Another seed is another noise, and no symmetry is left in it.
  const SolidFunction other = solidFunction(SolidNoise{2, 1, 0.5, 4});
  double apart = 0;
  double mirrored = 0;
  for (const Vec3& p : somePoints(200)) {
    apart += std::abs(f(p) - other(p));
    mirrored += std::abs(f(p) - f({p.y, p.x, p.z}));
  }
  EXPECT_GT(apart / 200, 0.05);
  EXPECT_GT(mirrored / 200, 0.05);
}

TEST(Solid, OctavesAddWhatTheirFormulaSays) {
  const SolidFunction one = solidFunction(SolidNoise{1, 1, 0.5, 1});
  const SolidFunction two = solidFunction(SolidNoise{1, 2, 0.5, 1});
  // The second octave is half as long: where the first is the same a half on lattice points, what
  // is left is a third of the second, which is at most 0.52 √2 there.
  double most = 0;
  for (int i = -20; i < 20; ++i) {
    const Vec3 p(i, 2 * i + 1, 7 - i);
    EXPECT_DOUBLE_EQ(one(p), 0.5);
    most = std::max(most, std::abs(two(p) - 0.5));
  }
  EXPECT_GT(most, 0.02);
  EXPECT_LT(most, 1.0 / 6 * 1.1);
}

/// Each scale lies about its point, so a line from one scale to another passes a groove; without
/// jitter the points are the middles of cubes.
TEST(Solid, CellsWithoutJitterAreCubes) {
  const SolidFunction f = solidFunction(SolidCells{2, 0, 0.2, 1});
  for (const Vec3& cube : {Vec3(0), Vec3(4, -6, 10)}) {
    EXPECT_NEAR(f(cube + Vec3(1, 1, 1)), 1, 1e-6);
    EXPECT_NEAR(f(cube + Vec3(0, 1, 1)), 0, 1e-6);
    EXPECT_NEAR(f(cube + Vec3(1, 1, 2)), 0, 1e-6);
    // Along an axis at half a groove's width from the border: smoothstep(½), and the dome.
    EXPECT_NEAR(f(cube + Vec3(0.1, 1, 1)), 0.5 * (1 - 0.6 * 0.45 * 0.45), 1e-3);
  }
}

TEST(Solid, RipplesWithoutMeanderArePlanes) {
  const SolidFunction f = solidFunction(SolidRipples{4, 0.7, 0, {0, 3, 4}, 1});
  for (const Vec3& p : somePoints(100)) {
    EXPECT_NEAR(f(p), f(p + Vec3(1, 0, 0)), 1e-9);
    EXPECT_NEAR(f(p), f(p + Vec3(0, 4, -3)), 1e-9);
  }
  EXPECT_NEAR(f({0, 0, 0}), 0, 1e-9);
  EXPECT_NEAR(f(2.8 * Vec3(0, 0.6, 0.8)), 1, 1e-9);
}

TEST(Solid, RefusesParametersOutOfRange) {
  const auto messageFor = [](const SolidPattern& solid) {
    return messageOf<InputError>([&] { (void)solidFunction(solid); });
  };
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(messageFor(SolidNoise{bad}), StartsWith("period: "));
    EXPECT_THAT(messageFor(SolidCells{bad}), StartsWith("period: "));
    EXPECT_THAT(messageFor(SolidRipples{bad}), StartsWith("period: "));
    EXPECT_THAT(messageFor(SolidCells{1, 0.5, bad}), StartsWith("groove: "));
  }
  EXPECT_THAT(messageFor(SolidNoise{1, 0}), StartsWith("octaves: "));
  EXPECT_THAT(messageFor(SolidNoise{1, 2, 1.5}), StartsWith("gain: "));
  EXPECT_THAT(messageFor(SolidCells{1, 1.5}), StartsWith("jitter: "));
  EXPECT_THAT(messageFor(SolidRipples{1, 1.0}), StartsWith("windward: "));
  EXPECT_THAT(messageFor(SolidRipples{1, 0.7, 0, Vec3(0)}), StartsWith("direction: "));
}

}  // namespace
}  // namespace gnomon::relief
