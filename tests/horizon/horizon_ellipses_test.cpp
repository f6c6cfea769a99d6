#include "horizon/angle_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "truth/truth_scenes.h"

namespace gnomon::horizon {
namespace {

using Slope = std::function<double(double azimuth)>;

struct Ellipse {
  Vec2 centre;
  double xx, xy, yy;  ///< A
};

/// Of one texel that sees the given slopes.
Ellipse fitted(const Slope& slope, int azimuths, double texelsPerHeight = 1) {
  HorizonTables tables;
  tables.width = 1;
  tables.height = 1;
  tables.layers = azimuths;
  for (int m = 0; m < azimuths; ++m) {
    tables.horizon.push_back(static_cast<float>(slope(2 * pi * m / azimuths)));
  }
  const std::vector<float> v = fitEllipses(tables, texelsPerHeight).values;
  EXPECT_EQ(v.size(), std::size_t{EllipseTable::numbers});
  return {{v[0], v[1]}, v[2], v[3], v[4]};
}

void expectEllipse(const Ellipse& e, const Ellipse& expected, double tolerance) {
  EXPECT_NEAR(e.centre.x, expected.centre.x, tolerance);
  EXPECT_NEAR(e.centre.y, expected.centre.y, tolerance);
  EXPECT_NEAR(e.xx, expected.xx, tolerance);
  EXPECT_NEAR(e.xy, expected.xy, tolerance);
  EXPECT_NEAR(e.yy, expected.yy, tolerance);
}

TEST(HorizonEllipses, FlatReliefIsLitFromTheWholeDisc) {
  for (const int azimuths : {3, 8, 32}) {
    expectEllipse(fitted([](double) { return 0.0; }, azimuths), {{0, 0}, 1, 0, 1}, 1e-6);
    // What lies below the tangent plane is no obstacle above it.
    expectEllipse(fitted([](double) { return -3.0; }, azimuths), {{0, 0}, 1, 0, 1}, 1e-6);
  }
}

TEST(HorizonEllipses, PitIsADiscAsWideAsItsMouth) {
  // A horizon of 60° all around: cos 60° = ½.
  expectEllipse(fitted([](double) { return std::sqrt(3.0); }, 16), {{0, 0}, 0.5, 0, 0.5}, 1e-6);
}

TEST(HorizonEllipses, AreOfTheSlopesInTheirFrame) {
  expectEllipse(fitted([](double) { return std::sqrt(3.0) / 8; }, 16, 8), {{0, 0}, 0.5, 0, 0.5},
                1e-6);
}

TEST(HorizonEllipses, HalfADiscBeforeAWallThatReachesTheSky) {
  // Lit within 90° of azimuth 0: centroid 4 / 3π, Σ = diag(¼ - 16 / 9π², ¼) by the half disc's
  // moments. 1025 sectors of 2048 are lit: one half too many, 1e-3 of the disc.
  const Ellipse e = fitted([](double a) { return std::cos(a) > -1e-9 ? 0.0 : 1e12; }, 2048);
  expectEllipse(
      e, {{4 / (3 * pi), 0}, 2 * std::sqrt(0.25 - 16 / (9 * pi * pi)), 0, 2 * std::sqrt(0.25)},
      2e-3);
}

TEST(HorizonEllipses, GrooveIsAnEllipseExactly) {
  // Walls k times as high as far, along azimuth t: δ = k |sin(φ - t)|, so that the lit part is
  // x² + (1 + k²) y² ≤ 1 turned by t: semi-axes 1 and 1 / √(1 + k²).
  for (const double k : {0.5, 1.0, 4.0}) {
    for (const double turn : {0.0, 0.4, pi / 2, 2.5}) {
      const Ellipse e = fitted([&](double a) { return k * std::abs(std::sin(a - turn)); }, 256);
      const double c = std::cos(turn);
      const double s = std::sin(turn);
      const double narrow = 1 / std::hypot(1.0, k);
      expectEllipse(
          e, {{0, 0}, c * c + narrow * s * s, (1 - narrow) * c * s, s * s + narrow * c * c}, 1e-5);
    }
  }
}

TEST(HorizonEllipses, HasTheCentroidAndMomentsOfRandomPointsInTheLitPart) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 4; ++trial) {
    std::array<double, 6> waves{};
    for (double& wave : waves) wave = uniform(random);
    const Slope slope = [&](double a) {
      return 0.4 + waves[0] * std::cos(a) + waves[1] * std::sin(a) + waves[2] * std::cos(2 * a) +
             waves[3] * std::sin(2 * a) + waves[4] * std::cos(3 * a) + waves[5] * std::sin(3 * a);
    };
    const Ellipse e = fitted(slope, 256);
    double count = 0;
    Vec2 first(0);
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (int i = 0; i < 2'000'000; ++i) {
      const Vec2 p(uniform(random), uniform(random));
      const double height = 1 - glm::dot(p, p);  // the direction's n component, squared
      if (height < 0) continue;
      // The direction is lit where it stands higher than the horizon in its azimuth.
      if (std::sqrt(height) < slope(std::atan2(p.y, p.x)) * glm::length(p)) continue;
      ++count;
      first += p;
      xx += p.x * p.x;
      xy += p.x * p.y;
      yy += p.y * p.y;
    }
    const Vec2 c = first / count;
    // A million points: standard errors of 1e-3 in the mean, less in the moments.
    EXPECT_NEAR(e.centre.x, c.x, 3e-3);
    EXPECT_NEAR(e.centre.y, c.y, 3e-3);
    // A² = 4 Σ.
    EXPECT_NEAR(e.xx * e.xx + e.xy * e.xy, 4 * (xx / count - c.x * c.x), 6e-3);
    EXPECT_NEAR(e.xy * (e.xx + e.yy), 4 * (xy / count - c.x * c.y), 6e-3);
    EXPECT_NEAR(e.yy * e.yy + e.xy * e.xy, 4 * (yy / count - c.y * c.y), 6e-3);
    EXPECT_GT(e.xx * e.yy, e.xy * e.xy) << "positive definite";
  }
}

TEST(HorizonEllipses, SlitIsALineOfNoWidth) {
  // One azimuth of four sees light: mean ρ = 2/3, ρ² = 1/2, so that Σ = diag(1/18, 0).
  const Ellipse e = fitted([](double a) { return std::cos(a) > 0.5 ? 0.0 : 1e12; }, 4);
  expectEllipse(e, {{2.0 / 3, 0}, 2 * std::sqrt(1.0 / 18), 0, 0}, 1e-6);
}

TEST(HorizonEllipses, TexelThatNoLightReachesHasNone) {
  for (const double slope : {1e30, double{std::numeric_limits<float>::infinity()}}) {
    expectEllipse(fitted([&](double) { return slope; }, 8), {{0, 0}, 0, 0, 0}, 1e-12);
  }
}

TEST(HorizonEllipses, EachTexelHasItsOwnInTheTablesOrder) {
  const relief::Relief relief = test::randomRelief(7, 5, 3, 2);
  const HorizonTables tables = bakeHorizons(relief.field, {16, 8});
  const EllipseTable all = fitEllipses(tables, 1);
  EXPECT_EQ(all.width, 7);
  EXPECT_EQ(all.height, 5);
  EXPECT_EQ(all.wrap, relief::Wrap::repeat);
  for (std::size_t texel = 0; texel < 35; ++texel) {
    const Ellipse one = fitted(
        [&](double a) {
          const auto m = static_cast<std::size_t>(std::lround(a / (2 * pi) * 16));
          return double{tables.horizon[m * 35 + texel]};
        },
        16);
    const Ellipse found{{all.values[texel], all.values[35 + texel]},
                        all.values[70 + texel],
                        all.values[105 + texel],
                        all.values[140 + texel]};
    expectEllipse(found, one, 1e-7);
  }
}

}  // namespace
}  // namespace gnomon::horizon
