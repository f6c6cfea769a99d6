#include "horizon/texel_scale.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/error.h"
#include "support/error_messages.h"
#include "surface/cage/shapes.h"
#include "truth/truth_scenes.h"

namespace gnomon::horizon {
namespace {

using test::flatRelief;

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

}  // namespace
}  // namespace gnomon::horizon
