#include "horizon/search_radius.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "relief/patch_border.h"
#include "surface/cage/shapes.h"

namespace gnomon::horizon {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

RayWay wayOf(double curvature, double degrees, double lowest, double highest) {
  return {curvature, std::tan(radians(degrees)), lowest, highest, endless, 1e6, 1e6};
}

Vec3 lightAt(double azimuth, double elevation) {
  const double a = radians(azimuth);
  const double e = radians(elevation);
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

/// Heights 0 and `height`, once each at least.
relief::Relief reliefOf(int side, float height, relief::Wrap wrap = relief::Wrap::repeat) {
  std::vector<float> texels(static_cast<std::size_t>(side * side));
  texels[3] = height;
  return {relief::HeightField(side, side, std::move(texels), wrap), relief::HeightSpace::world,
          Vec2(1)};
}

TEST(EndOfRay, OnAPlaneIsTheHeightOverTheSlope) {
  for (const double degrees : {2.0, 20.0, 70.0}) {
    const RayEnd end = endOf(wayOf(0, degrees, 1, 9));
    EXPECT_EQ(end.bound, RadiusBound::leaves);
    EXPECT_NEAR(end.distance, 8 / std::tan(radians(degrees)), 1e-9);
    // A circle that is all but a line.
    EXPECT_NEAR(endOf(wayOf(1e-10, degrees, 1, 9)).distance, end.distance, 1e-4 * end.distance);
    EXPECT_NEAR(endOf(wayOf(-1e-10, degrees, 1, 9)).distance, end.distance, 1e-4 * end.distance);
  }
  EXPECT_EQ(endOf(wayOf(0, -1, 0, 9)).bound, RadiusBound::unlit);
}

/// On a circle of radius R about the origin the ray starts at (0, R + h₀) and leaves where it is
/// R + h₁ from the origin: a quadratic equation for its length.
TEST(EndOfRay, OnASphereIsWhereTheRayIsAsFarAsTheHighestBump) {
  const double radius = 60;
  for (const double degrees : {60.0, 20.0, 3.0, 0.0, -10.0, -25.0}) {
    const double lowest = 1;
    const double highest = 8;
    const double e = radians(degrees);
    const double start = radius + lowest;
    const double up = start * std::sin(e);
    const double ray =
        -up + std::sqrt(up * up + (radius + highest) * (radius + highest) - start * start);
    const double arc = radius * std::atan2(ray * std::cos(e), start + ray * std::sin(e));
    const RayEnd end = endOf(wayOf(1 / radius, degrees, lowest, highest));
    EXPECT_EQ(end.bound, RadiusBound::leaves);
    EXPECT_NEAR(end.distance, arc, 1e-9 * arc) << degrees;
  }
  // Below the bare surface's horizon from the highest bump no light comes.
  const double dip = std::acos(60.0 / 68) * 180 / pi;
  EXPECT_EQ(endOf(wayOf(1 / radius, -dip - 0.1, 1, 8)).bound, RadiusBound::unlit);
  EXPECT_EQ(endOf(wayOf(1 / radius, -dip + 0.1, 1, 8)).bound, RadiusBound::leaves);
}

/// In a bowl the circle's centre is above: the ray is out of the relief while it is nearer than R -
/// h₁ to it.
TEST(EndOfRay, InABowlTheGroundComesUpAgain) {
  const double radius = 60;
  const double e = radians(50.0);
  // From (0, -R + 1), with 8 the highest.
  const double down = (radius - 1) * std::sin(e);
  const double square = down * down + (radius - 8) * (radius - 8) - (radius - 1) * (radius - 1);
  ASSERT_GT(square, 0);
  const auto arcAt = [&](double ray) {
    return radius * std::atan2(ray * std::cos(e), radius - 1 - ray * std::sin(e));
  };
  const double out = arcAt(down - std::sqrt(square));
  const double back = arcAt(down + std::sqrt(square));
  RayWay way = wayOf(-1 / radius, 50, 1, 8);
  way.border = back - 1;
  EXPECT_EQ(endOf(way).bound, RadiusBound::leaves);
  EXPECT_NEAR(endOf(way).distance, out, 1e-9 * out);
  // Beyond a quarter turn the circle says nothing of the surface: there the ray does not come back.
  way.border = endless;
  EXPECT_GT(back, 0.5 * pi * radius);
  EXPECT_EQ(endOf(way).bound, RadiusBound::leaves);
  // A lower ray comes back before that, or never gets out.
  for (const double degrees : {5.0, 30.0}) {
    way = wayOf(-1 / radius, degrees, 1, 8);
    EXPECT_EQ(endOf(way).bound, RadiusBound::quarterTurn);
    EXPECT_DOUBLE_EQ(endOf(way).distance, 0.5 * pi * radius);
  }
  // One that never gets out goes to the nearest end.
  way = wayOf(-1 / radius, 5, 1, 8);
  way.border = 40;
  EXPECT_EQ(endOf(way).bound, RadiusBound::border);
  EXPECT_EQ(endOf(way).distance, 40);
  way.tile = 30;
  EXPECT_EQ(endOf(way).bound, RadiusBound::tile);
  EXPECT_EQ(endOf(way).distance, 30);
  EXPECT_EQ(endOf(wayOf(-1 / radius, -1, 0, 8)).bound, RadiusBound::unlit);
}

TEST(SearchRadiusRule, OnAPlaneIsTheLongestShadow) {
  const surface::LimitSurface plane(surface::makePlane(400, 400, 8, 8));
  relief::Relief relief = reliefOf(64, 6);
  relief.repeats = Vec2(4);  // 400 / 256 world units a texel
  const double texel = 400.0 / 256;
  for (const double elevation : {50.0, 20.0, 2.0}) {
    const std::vector<Vec3> lights{lightAt(0, 70), lightAt(90, elevation)};
    const SearchRadius found = searchRadius(plane, relief, lights);
    EXPECT_EQ(found.texels, std::ceil(6 / std::tan(radians(elevation)) / texel));
    EXPECT_EQ(found.bound, RadiusBound::leaves);
    EXPECT_EQ(found.light, 1U);
  }
  // Heights in texels grow with them.
  relief.space = relief::HeightSpace::texture;
  EXPECT_EQ(searchRadius(plane, relief, std::vector{lightAt(30, 20)}).texels,
            std::ceil(6 / std::tan(radians(20.0))));
  EXPECT_EQ(searchRadius(plane, relief, std::vector{lightAt(0, 90)}).texels, 1);
  EXPECT_EQ(searchRadius(plane, relief, std::vector{lightAt(0, -5)}).bound, RadiusBound::unlit);
}

TEST(SearchRadiusRule, EndsAtTheBorderAndWithTheSurface) {
  const surface::LimitSurface plane(surface::makePlane(64, 64, 8, 8));
  relief::Relief relief = reliefOf(64, 6, relief::Wrap::clamp);
  relief.field = relief.field.withBorder({true, true});
  // At 1° a shadow is 344 long, and no ray along x is longer than 64.
  const SearchRadius ended = searchRadius(plane, relief, std::vector{lightAt(0, 1)});
  EXPECT_EQ(ended.bound, RadiusBound::border);
  EXPECT_EQ(ended.texels, 64);
  relief = reliefOf(64, 6);
  relief.repeats = Vec2(2);
  const SearchRadius whole = searchRadius(plane, relief, std::vector{lightAt(0, 1)});
  EXPECT_EQ(whole.bound, RadiusBound::tile);
  EXPECT_EQ(whole.texels, std::ceil(64 * std::sqrt(2.0)));
}

TEST(PatchBorder, IsWhereMapAndSurfaceEnd) {
  const auto borderOn = [](const surface::Cage& cage, relief::Wrap wrap, Vec2 repeats) {
    return relief::borderOf(cage, surface::LimitSurface(cage), wrap, repeats);
  };
  const relief::Border both{true, true};
  const relief::Border none{};
  const surface::Cage plane = surface::makePlane(10, 10, 4, 3);
  const surface::Cage torus = surface::makeTorus(20, 5, 60, 60);
  EXPECT_EQ(borderOn(plane, relief::Wrap::clamp, Vec2(1)), both);
  EXPECT_EQ(borderOn(plane, relief::Wrap::repeat, Vec2(1)), both);
  EXPECT_EQ(borderOn(plane, relief::Wrap::repeat, Vec2(2, 1)), (relief::Border{false, true}));
  EXPECT_EQ(borderOn(plane, relief::Wrap::clamp, Vec2(1, 3)), (relief::Border{true, false}));
  EXPECT_EQ(borderOn(torus, relief::Wrap::repeat, Vec2(1)), none);
  EXPECT_EQ(borderOn(torus, relief::Wrap::clamp, Vec2(1)), both) << "its author says that it ends";
  EXPECT_EQ(borderOn(surface::makeCylinder(10, 2 * pi, 30, 60, 4), relief::Wrap::repeat, Vec2(1)),
            (relief::Border{false, true}));
  // A mesh of its own charts.
  surface::Cage mesh = plane;
  mesh.grid.reset();
  EXPECT_EQ(borderOn(mesh, relief::Wrap::repeat, Vec2(1)), none)
      << "how its charts go on is not known";
}

}  // namespace
}  // namespace gnomon::horizon
