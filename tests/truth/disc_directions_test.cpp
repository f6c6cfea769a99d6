#include "truth/disc_directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "truth/disc_scenes.h"
#include "truth/truth_scenes.h"

namespace gnomon::truth {
namespace {

using test::flatShare;
using test::lightToward;

/// Of some points, the share whose place along an angle is below a line.
double shareBelow(std::span<const Vec2> points, double angle, double line) {
  const Vec2 along(std::cos(angle), std::sin(angle));
  const auto below = std::count_if(points.begin(), points.end(), [&](const Vec2& point) {
    return glm::dot(point, along) < line;
  });
  return static_cast<double>(below) / static_cast<double>(points.size());
}

/// Root mean square and largest error of the share, over edges of an angle, in points.
struct EdgeErrors {
  double rms = 0;
  double largest = 0;
};
EdgeErrors edgeErrors(std::span<const Vec2> points, double angle) {
  constexpr int lines = 401;
  EdgeErrors errors;
  for (int k = 0; k < lines; ++k) {
    const double line = 2.0 * k / (lines - 1) - 1;
    const double error = shareBelow(points, angle, line) - flatShare(line, 0, 1);
    errors.rms += error * error / lines;
    errors.largest = std::max(errors.largest, std::abs(error));
  }
  const auto count = static_cast<double>(points.size());
  return {count * std::sqrt(errors.rms), count * errors.largest};
}

TEST(DiscPoints, StandForEqualAreasAlongEveryEdge) {
  for (const int count : {64, 128, 256}) {
    const std::vector<Vec2> points = discPoints(count);
    double squares = 0;
    double largest = 0;
    constexpr int angles = 90;
    for (int k = 0; k < angles; ++k) {
      const EdgeErrors errors = edgeErrors(points, pi * (k + 0.3) / angles);
      squares += errors.rms * errors.rms / angles;
      largest = std::max(largest, errors.largest);
    }
    EXPECT_LT(std::sqrt(squares), 1.15) << count;
    EXPECT_LT(largest, 5.5) << count;
  }
}

TEST(DiscPoints, HalveNoMoreThanOneAlongEitherAxis) {
  for (const int count : {2, 16, 128, 256, 1024}) {
    const std::vector<Vec2> points = discPoints(count);
    for (const double angle : {0.0, pi / 2, pi}) {
      EXPECT_LT(edgeErrors(points, angle).largest, 0.75) << count << " at " << angle;
    }
  }
}

TEST(DiscRim, NoLargeHalfPlaneMissesIt) {
  const std::vector<Vec2> rim = discRim(16);
  const double angle = pi / 16;
  const double largest = (angle - std::sin(angle) * std::cos(angle)) / pi;
  EXPECT_NEAR(largest, 0.0016, 5e-5);
  // Half-way between two of them, the edge that both lie on.
  EXPECT_NEAR(1 - flatShare(std::cos(angle), 0, 1), largest, 1e-12);
  EXPECT_NEAR(shareBelow(rim, angle, std::cos(angle) - 1e-9), 14.0 / 16, 1e-12);
}

TEST(DiscDirections, FillTheCapEvenly) {
  const double radius = radians(10);
  const Vec3 centre = lightToward(40, 35);
  const std::vector<Vec3> directions = discDirections(centre, radius, discPoints(1024));
  Vec3 mean(0);
  for (const Vec3& direction : directions) {
    EXPECT_NEAR(glm::length(direction), 1, 1e-14);
    EXPECT_LE(std::acos(glm::dot(direction, centre)), radius + 1e-9);
    mean += direction / 1024.0;
  }
  // The mean direction of a cap is its centre times (1 + cos ρ) / 2.
  EXPECT_NEAR(glm::length(mean - centre * (1 + std::cos(radius)) / 2.0), 0, 2e-5);
  // Equal solid angle: half of them within the cap of half the solid angle.
  const double half = (1 + std::cos(radius)) / 2;
  const auto inner =
      std::count_if(directions.begin(), directions.end(),
                    [&](const Vec3& direction) { return glm::dot(direction, centre) > half; });
  EXPECT_NEAR(static_cast<double>(inner) / 1024, 0.5, 0.01);
}

TEST(DiscDirections, APointLightHasOneAndAZenithAny) {
  for (const Vec3& direction : discDirections(lightToward(10, 20), 0, discPoints(8))) {
    EXPECT_NEAR(glm::length(direction - lightToward(10, 20)), 0, 1e-15);
  }
  for (const Vec3& direction : discDirections(Vec3(0, 0, 1), 0.1, discPoints(8))) {
    EXPECT_GE(direction.z, std::cos(0.1) - 1e-12);
  }
}

TEST(DiscDirections, TheLowestIsTheCentreARadiusLower) {
  const Vec3 centre = lightToward(200, 20);
  EXPECT_NEAR(glm::length(lowestOfDisc({centre, radians(3)}) - lightToward(200, 17)), 0, 1e-15);
  EXPECT_EQ(lowestOfDisc({centre}), centre);
  EXPECT_NEAR(lowestOfDisc({Vec3(0, 0, 1), 0.1}).z, std::cos(0.1), 1e-15);
}

}  // namespace
}  // namespace gnomon::truth
