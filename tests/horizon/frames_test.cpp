#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "common/error.h"
#include "horizon/angle_table.h"
#include "horizon/search_radius.h"
#include "relief/relief.h"
#include "support/error_messages.h"
#include "surface/cage/shapes.h"
#include "truth/truth_scenes.h"

namespace gnomon::horizon {
namespace {

using test::flatRelief;
using test::stepRelief;

HorizonTables tableOf(RawVector<float> slopes) {
  HorizonTables tables;
  tables.width = static_cast<int>(slopes.size());
  tables.height = 1;
  tables.layers = 1;
  tables.horizon = std::move(slopes);
  return tables;
}

TEST(AngleTable, AnglesAreOffTheNormal) {
  const AngleTable table = horizonAngles(tableOf({0, 1, -1, 1e20F, -1e20F}), pi, 1);
  EXPECT_FLOAT_EQ(table.angles[0], static_cast<float>(pi / 2));
  EXPECT_FLOAT_EQ(table.angles[1], static_cast<float>(pi / 4));
  EXPECT_FLOAT_EQ(table.angles[2], static_cast<float>(3 * pi / 4));
  EXPECT_NEAR(table.angles[3], 0, 1e-6);
  EXPECT_NEAR(table.angles[4], pi, 1e-6);
}

TEST(AngleTable, EndsAtItsLimit) {
  const AngleTable table = horizonAngles(tableOf({0, 1, -0.1F, -5}), pi / 2, 1);
  EXPECT_FLOAT_EQ(table.angles[1], static_cast<float>(pi / 4));
  for (const std::size_t i : {0U, 2U, 3U}) {
    EXPECT_FLOAT_EQ(table.angles[i], static_cast<float>(pi / 2));
  }
  EXPECT_DOUBLE_EQ(table.limit, pi / 2);
  EXPECT_FLOAT_EQ(horizonAngles(tableOf({1}), 0.5, 1).angles[0], 0.5F);
}

TEST(AngleTable, AreOfTheSlopesInTheirFrame) {
  const AngleTable table = horizonAngles(tableOf({0, 0.25F, -0.25F}), pi, 4);
  EXPECT_FLOAT_EQ(table.angles[0], static_cast<float>(pi / 2));
  EXPECT_FLOAT_EQ(table.angles[1], static_cast<float>(pi / 4));
  EXPECT_FLOAT_EQ(table.angles[2], static_cast<float>(3 * pi / 4));
}

TEST(AngleTable, OfAWallIsItsElevation) {
  const relief::Relief wall = stepRelief(32, 4, 6, [](int i, int) { return i < 8; });
  const HorizonTables tables = bakeHorizons(wall.field, {4, 64});
  const AngleTable table = horizonAngles(tables, pi / 2, 1);
  EXPECT_EQ(table.width, 32);
  EXPECT_EQ(table.height, 4);
  EXPECT_EQ(table.layers, 4);
  EXPECT_EQ(table.wrap, relief::Wrap::clamp);
  EXPECT_EQ(table.originX, 0);
  EXPECT_EQ(table.originY, 0);
  for (int x = 8; x < 32; ++x) {
    // Toward -x, azimuth 2 of 4: the edge of the wall's top at x = 7.5, 6 above the floor.
    const auto at = [&](int m) {
      return table.angles[static_cast<std::size_t>((m * 4 + 2) * 32 + x)];
    };
    EXPECT_NEAR(at(2), std::atan2(x + 0.5 - 7.5, 6), 1e-6);
    EXPECT_NEAR(at(0), pi / 2, 1e-6);
  }
}

double frameOn(const surface::Cage& cage, relief::Relief relief) {
  return texelsPerHeight(relief.space,
                         texelScale(surface::LimitSurface(cage), relief.texelsPerUv()));
}

relief::Relief inWorldUnits(int texels, Vec2 repeats = Vec2(1)) {
  relief::Relief relief = flatRelief(texels, texels);
  relief.space = relief::HeightSpace::world;
  relief.repeats = repeats;
  return relief;
}

TEST(AngleFrame, OfHeightsInTexelsIsTheTexturesOwn) {
  relief::Relief relief = flatRelief(32, 32);
  relief.space = relief::HeightSpace::texture;
  EXPECT_EQ(frameOn(surface::makePlane(96, 48, 8, 8), relief), 1);
}

TEST(AngleFrame, OfHeightsInWorldUnitsIsTheWorldsOwnOnAverage) {
  // Texels 3 wide and 1.5 high.
  EXPECT_NEAR(frameOn(surface::makePlane(96, 48, 8, 8), inWorldUnits(32)), 1 / std::sqrt(4.5),
              1e-9);
  // Twice as many in x and three times as many in y.
  EXPECT_NEAR(frameOn(surface::makePlane(96, 48, 8, 8), inWorldUnits(32, {2, 3})),
              std::sqrt(6 / 4.5), 1e-9);
  // A torus of 4π² R r.
  EXPECT_NEAR(frameOn(surface::makeTorus(30, 10, 72, 60), inWorldUnits(64)),
              64 / std::sqrt(4 * pi * pi * 30 * 10), 1e-3);
}

TEST(AngleFrame, ScalesWithTheUnitOfLength) {
  const double one = frameOn(surface::makeSphere(60, 1.2, 1.2, 24, 24), inWorldUnits(72));
  EXPECT_EQ(frameOn(surface::makeSphere(60 * 16, 1.2, 1.2, 24, 24), inWorldUnits(72)), one / 16);
  EXPECT_NEAR(frameOn(surface::makeSphere(60e-3, 1.2, 1.2, 24, 24), inWorldUnits(72)), one * 1e3,
              one * 1e-9);
}

TEST(AngleFrame, LeavesFacesWithoutATextureOut) {
  surface::Cage cage = surface::makePlane(24, 24, 3, 3);
  cage.grid.reset();
  constexpr std::size_t middle = 12;  // of the cage's 5 × 5 faces, of which the outer ones support
  for (std::size_t corner = 0; corner < 4; ++corner) {
    cage.faceUvs[4 * middle + corner] = cage.faceUvs[4 * middle];
  }
  EXPECT_NEAR(frameOn(cage, inWorldUnits(24)), 1, 1e-9);
  for (Vec2& uv : cage.uvs) uv = Vec2(0.5);
  EXPECT_EQ(frameOn(cage, inWorldUnits(24)), 1);
}

TEST(TexelScale, IsOfAllTheSurface) {
  surface::Cage cage = surface::makePlane(96, 48, 8, 8);
  for (Vec3& point : cage.positions) point += Vec3(0, -200, 10);
  const TexelScale scale = texelScale(surface::LimitSurface(cage), Vec2(32, 32));
  EXPECT_NEAR(scale.width, std::sqrt(4.5), 1e-9);
  EXPECT_NEAR(scale.farthest, 224, 1);
}

TEST(TexelScale, IsRefusedWhereFloatsCannotHoldIt) {
  const auto onPlane = [](double size, Vec3 shift) {
    surface::Cage cage = surface::makePlane(size, size, 8, 8);
    for (Vec3& point : cage.positions) point += shift;
    return texelScale(surface::LimitSurface(cage), Vec2(100)).width;
  };
  for (const double size : {1.1e-5, 1.0, 0.9e9}) {
    EXPECT_NEAR(onPlane(size, Vec3(0)), size / 100, size * 1e-9);
  }
  const auto refusal = [&](double size, Vec3 shift) {
    return messageOf<InputError>([&] { (void)onPlane(size, shift); });
  };
  EXPECT_EQ(refusal(1e-6, Vec3(0)),
            "surface: a texel is 1e-08 world units wide on average, 1e-07 to 1e+07 expected: scale "
            "the mesh or its texture coordinates");
  EXPECT_THAT(refusal(1e10, Vec3(0)), testing::HasSubstr("a texel is 1e+08 world units wide"));
  EXPECT_NEAR(onPlane(100, Vec3(1e5, 0, 0)), 1, 1e-6);
  EXPECT_THAT(refusal(100, Vec3(0, 0, -1e6)),
              testing::HasSubstr("reaches 1e+06 world units from the origin, where floats are "
                                 "0.119 apart and a texel is 1 wide"));
}

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
