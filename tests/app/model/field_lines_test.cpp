#include "model/cross_section.h"

#include <gtest/gtest.h>

#include <cmath>

#include "truth/truth_scenes.h"

namespace gnomon::app {
namespace {

using test::lightToward;
using test::samplesOfAllFaces;

Vec3 directionOf(const LineSegment& line) {
  return glm::normalize(line.end - line.begin);
}

TEST(PrincipalLines, OfACylinderRunRoundAndAlongIt) {
  constexpr double radius = 20;
  const surface::LimitSurface surface(surface::makeCylinder(radius, 2, 30, 24, 10));
  const LineSettings settings{2, 0.5, 0.1};
  const PrincipalLines lines = principalLines(surface, settings);
  ASSERT_EQ(lines.larger.size(), 24U * 10 * 4);
  ASSERT_EQ(lines.smaller.size(), lines.larger.size());
  const double spacing = 2 * radius / 24 / 2;  // the shorter side of a face
  for (std::size_t k = 0; k < lines.larger.size(); ++k) {
    EXPECT_NEAR(std::abs(directionOf(lines.smaller[k]).y), 1, 1e-6);
    EXPECT_NEAR(directionOf(lines.larger[k]).y, 0, 1e-6);
    EXPECT_NEAR(glm::distance(lines.larger[k].begin, lines.larger[k].end), 0.5 * spacing,
                1e-2 * spacing);
    // Over the surface, touching it from outside.
    const Vec3 middle = 0.5 * (lines.larger[k].begin + lines.larger[k].end);
    EXPECT_NEAR(std::hypot(middle.x, middle.z), radius + 0.1 * spacing, 1e-2 * spacing);
  }
}

TEST(PrincipalLines, OfATorusAreOrthogonalAndTangential) {
  const surface::LimitSurface surface(surface::makeTorus(30, 10, 96, 66));
  const PrincipalLines lines = principalLines(surface, {1, 0.6, 0.02});
  EXPECT_EQ(lines.larger.size(), 96U * 66);
  for (std::size_t k = 0; k < lines.larger.size(); ++k) {
    const Vec3 v1 = directionOf(lines.larger[k]);
    EXPECT_NEAR(glm::dot(v1, directionOf(lines.smaller[k])), 0, 1e-9);
    const Vec3 at = 0.5 * (lines.larger[k].begin + lines.larger[k].end);
    // The larger curvature, 1 / minor, runs round the tube: in the plane of at and the axis.
    EXPECT_NEAR(glm::dot(v1, glm::normalize(Vec3(-at.z, 0, at.x))), 0, 1e-3);
  }
}

TEST(PrincipalLines, AreAbsentWhereEveryDirectionIsPrincipal) {
  EXPECT_TRUE(
      principalLines(surface::LimitSurface(surface::makePlane(40, 40, 8, 8))).larger.empty());
  EXPECT_TRUE(principalLines(surface::LimitSurface(surface::makeSphere(30, 1.4, 1.4, 24, 24)))
                  .larger.empty());
}

TEST(CurvatureField, FollowsEulersFormulaOnACylinder) {
  constexpr double radius = 20;
  const surface::LimitSurface surface(surface::makeCylinder(radius, 2, 30, 24, 10));
  const surface::SampleGrid samples = samplesOfAllFaces(surface, 2);
  const Vec3 light = lightToward(25, 40);
  const CurvatureField field = curvatureAlong(surface, samples, light);
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    ASSERT_EQ(field.defined[i], 1);
    const surface::SurfaceSample& sample = samples.samples[i];
    const Vec3 at = surface.evaluate(sample).position;
    const Vec3 round = glm::normalize(Vec3(at.z, 0, -at.x));
    const double along = light.y;
    const double across = glm::dot(light, round);
    const double expected = across * across / (across * across + along * along) / radius;
    EXPECT_NEAR(field.values[i], expected, 2e-3 / radius);
    EXPECT_LE(std::abs(field.values[i]), field.largest);
  }
}

TEST(CurvatureField, IsZeroAndSaysSoWhereItHasNoMeaning) {
  const surface::LimitSurface plane(surface::makePlane(40, 40, 4, 4));
  surface::SampleGrid samples = samplesOfAllFaces(plane, 1);
  samples.samples[3].face = -1;
  const CurvatureField zenith = curvatureAlong(plane, samples, Vec3(0, 0, 1));
  const CurvatureField slanted = curvatureAlong(plane, samples, lightToward(10, 45));
  EXPECT_NEAR(slanted.largest, 0, 1e-12);
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    EXPECT_EQ(zenith.defined[i], 0);
    EXPECT_EQ(zenith.values[i], 0);
    EXPECT_EQ(slanted.defined[i], i == 3 ? 0 : 1);
  }
}

/// Relative luminance of linear light (Rec. 709), from sRGB.
double luminance(const image::Rgb& colour) {
  const auto linear = [](std::uint8_t c) {
    const double v = c / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
}

TEST(CurvatureColours, DivergeFromFlatAndGrowDarkerToBothEnds) {
  EXPECT_EQ(curvatureColour(0, 1), CurvatureColours::flat);
  EXPECT_EQ(curvatureColour(5, 0), CurvatureColours::flat);
  EXPECT_EQ(curvatureColour(-2, 2), CurvatureColours::concave);
  EXPECT_EQ(curvatureColour(9, 2), CurvatureColours::convex);
  EXPECT_EQ(curvatureColour(std::nan(""), 2), CurvatureColours::flat);
  for (const double sign : {-1.0, 1.0}) {
    for (double value = 0.1; value <= 1; value += 0.1) {
      EXPECT_LT(luminance(curvatureColour(sign * value, 1)),
                luminance(curvatureColour(sign * (value - 0.1), 1)));
    }
  }
}

}  // namespace
}  // namespace gnomon::app
