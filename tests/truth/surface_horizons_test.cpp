#include "truth/surface_horizons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "relief/patterns.h"
#include "surface/texel_frame.h"
#include "truth/micro_surface.h"
#include "truth/truth_scenes.h"

namespace gnomon::truth {
namespace {

using test::flatRelief;
using test::sampleAt;
using test::stepRelief;

constexpr double precision = 1e-3;  // as stated: radians

struct HorizonScene : test::MicroSurface {
  using MicroSurface::MicroSurface;

  /// Of texel centres x0 … x0 + columns - 1 by y0 … y0 + rows - 1.
  [[nodiscard]] horizon::AngleTable shoot(int x0, int y0, int columns, int rows, int azimuths,
                                          double limit) const {
    surface::SampleGrid texels{columns, rows, {}};
    for (int y = y0 + rows - 1; y >= y0; --y) {
      for (int x = x0; x < x0 + columns; ++x) {
        texels.samples.push_back(sampleAt(surface, relief, Vec2(x, y) + 0.5));
      }
    }
    return shootHorizons(surface, relief, mesh, scene, texels, azimuths, limit);
  }
};

TEST(SurfaceHorizons, BesideABoxAreItsElevation) {
  // A box 8 × 8, 6 high; its top ends at 31.5 and 24.5 toward +x, at 16.5 … 24.5 in y.
  const HorizonScene scene(
      surface::makePlane(64, 40, 8, 5),
      stepRelief(64, 40, 6, [](int i, int j) { return i >= 24 && i < 32 && j >= 16 && j < 24; }),
      0.5);
  const horizon::AngleTable table = scene.shoot(33, 20, 28, 1, 4, pi / 2);
  EXPECT_EQ(table.width, 28);
  EXPECT_EQ(table.height, 1);
  for (int i = 0; i < 28; ++i) {
    const double expected = std::atan2(33.5 + i - 31.5, 6);
    const auto at = [&](int m) { return table.angles[static_cast<std::size_t>(m * 28 + i)]; };
    EXPECT_LE(at(2), expected + 1e-5) << i;
    EXPECT_GE(at(2), expected - precision - 1e-5) << i;
    for (const int m : {0, 1, 3}) EXPECT_NEAR(at(m), pi / 2, 1e-6);
  }
}

TEST(SurfaceHorizons, RowsAndAzimuthsRunAsTheMapDoes) {
  // Highest where x is least and y is greatest: the first of four texels along x, the last along y.
  const HorizonScene scene(surface::makePlane(16, 16, 4, 4),
                           stepRelief(16, 16, 9, [](int i, int j) { return i < 4 && j >= 12; }),
                           0.5);
  const horizon::AngleTable table = scene.shoot(0, 0, 16, 16, 8, pi / 2);
  const auto angle = [&](int x, int y, int m) {
    return table.angles[static_cast<std::size_t>((m * 16 + y) * 16 + x)];
  };
  EXPECT_NEAR(angle(10, 13, 4), std::atan2(10.5 - 3.5, 9), precision + 1e-5);
  EXPECT_NEAR(angle(1, 5, 2), std::atan2(12.5 - 5.5, 9), precision + 1e-5);
  EXPECT_NEAR(angle(8, 8, 3), std::atan2((12.5 - 8.5) * std::sqrt(2), 9), 0.2);
  EXPECT_NEAR(angle(10, 13, 0), pi / 2, 1e-6);
  EXPECT_NEAR(angle(10, 2, 4), pi / 2, 1e-6);
}

TEST(SurfaceHorizons, BareSphereEndsAtItsTangentPlane) {
  const HorizonScene scene(surface::makeSphere(40, 1.6, 1.2, 40, 32), flatRelief(64, 48), 0.125);
  for (const double limit : {pi / 2, pi}) {
    const horizon::AngleTable table = scene.shoot(8, 8, 48, 32, 8, limit);
    for (const float angle : table.angles) {
      EXPECT_LE(angle, static_cast<float>(limit));
      // A facet of 0.125 world units is tilted by up to 0.125 / 40 / √2 from its middle's normal.
      ASSERT_NEAR(angle, pi / 2, 0.003 + precision);
    }
  }
}

TEST(SurfaceHorizons, LessThanAHalfTurnIsKeptToItsLimit) {
  const HorizonScene scene(surface::makeSphere(40, 1.6, 1.2, 40, 32), flatRelief(64, 48), 0.5);
  for (const float angle : scene.shoot(30, 20, 2, 2, 8, 0.7).angles) EXPECT_FLOAT_EQ(angle, 0.7F);
}

/// Eq. (3) of Onoue, Max & Nishita 2004: 90° + arccos(R / (R + h)).
TEST(SurfaceHorizons, TipOfAPinSeesBelowItsTangentPlane) {
  for (const double height : {2.0, 5.0, 9.0}) {
    constexpr double radius = 60;
    const HorizonScene scene(
        surface::makeSphere(radius, 2, 2, 39, 39),
        stepRelief(81, 81, height, [](int i, int j) { return i == 40 && j == 40; }), 0.2);
    // Facets fall from the tip on all sides: toward every azimuth rays start on the one there.
    const horizon::AngleTable table = scene.shoot(40, 40, 1, 1, 8, pi);
    const double kappa = 1 / radius;
    const double expected = pi / 2 + std::acos(1 / (1 + kappa * height));
    for (const float angle : table.angles) EXPECT_NEAR(angle, expected, 2 * precision);
    for (const float angle : scene.shoot(40, 40, 1, 1, 8, pi / 2).angles) {
      EXPECT_NEAR(angle, pi / 2, 1e-6);
    }
  }
}

TEST(SurfaceHorizons, OnAPlaneAreTheFlatReliefs) {
  // Cosines of x and of y added: flat inside each cell, so that facets are the relief itself.
  const relief::Relief relief{relief::makeCosine(48, 48, {12}, 6, relief::Wrap::clamp),
                              relief::HeightSpace::world, Vec2(1)};
  const horizon::HorizonTables baked = horizon::bakeHorizons(relief.field, {16, 200});
  const horizon::AngleTable flat = horizon::horizonAngles(baked, pi / 2, 1);
  const HorizonScene scene(surface::makePlane(48, 48, 8, 8), relief, 0.5);
  const horizon::AngleTable shot = scene.shoot(0, 0, 48, 48, 16, pi / 2);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < shot.angles.size(); ++i) {
    const auto x = static_cast<int>(i % 48);
    const auto y = static_cast<int>(i / 48 % 48);
    const double azimuth = 2 * pi * static_cast<double>(i / (48 * 48)) / 16;
    if (baked.distance[i] < 1.5F || flat.angles[i] > 1.5F) continue;
    // The plane does not go on beyond its border, as the map does.
    const Vec2 occluder =
        Vec2(x, y) + double{baked.distance[i]} * Vec2(std::cos(azimuth), std::sin(azimuth));
    if (glm::any(glm::lessThan(occluder, Vec2(0))) ||
        glm::any(glm::greaterThan(occluder, Vec2(47)))) {
      continue;
    }
    ++compared;
    EXPECT_LE(shot.angles[i], flat.angles[i] + 1e-3);
    EXPECT_GE(shot.angles[i], flat.angles[i] - precision - 1e-3);
  }
  EXPECT_GT(compared, shot.angles.size() / 5);
}

/// In the hole of a torus the far side stands before the sky: light comes through a gap, or not at
/// all.
TEST(SurfaceHorizons, InATorussHoleAreTheLowestRaysThatEscape) {
  const HorizonScene scene(surface::makeTorus(30, 14, 64, 64), flatRelief(64, 64), 0.25);
  constexpr int azimuths = 48;
  const horizon::AngleTable table = scene.shoot(20, 2, 1, 1, azimuths, pi / 2);
  const surface::SurfaceSample sample = sampleAt(scene.surface, scene.relief, {20.5, 2.5});
  const surface::TexelFrame frame =
      surface::texelFrame(scene.surface.evaluate(sample), scene.relief.texelsPerUv());
  int gaps = 0;
  for (int m = 0; m < azimuths; ++m) {
    const double azimuth = 2 * pi * m / azimuths;
    // The texel's centre is a corner of facets: the one that the azimuth leads onto.
    const Vec2 onward = Vec2(20.5, 2.5) + 1e-3 * Vec2(std::cos(azimuth), std::sin(azimuth));
    const Facet facet = scene.mesh.facet(sampleAt(scene.surface, scene.relief, onward));
    const Vec3 tangent =
        glm::normalize(std::cos(azimuth) * frame.px + std::sin(azimuth) * frame.py);
    // From the tangent plane upward, by a twentieth of a degree: the first ray that escapes, and
    // how far on rays escape.
    double first = -1;
    double width = 0;
    for (double off = 90; off >= 0; off -= 0.05) {
      const Vec3 direction =
          std::cos(radians(off)) * frame.normal + std::sin(radians(off)) * tangent;
      const bool free = glm::dot(direction, facet.normal) > 0 &&
                        !scene.scene.occluded(facet.point + 1e-4 * facet.normal, direction);
      if (free && first < 0) first = off;
      if (free) width = first - off;
      if (!free && first >= 0) break;
    }
    const double found = table.angles[static_cast<std::size_t>(m)];
    if (first < 0) {
      EXPECT_EQ(found, 0) << m;
    } else if (width > 4) {
      EXPECT_NEAR(found, radians(first), precision + radians(0.06)) << m;
      gaps += first < 85 ? 1 : 0;
    }
  }
  EXPECT_GT(gaps, 3);
}

TEST(SurfaceHorizons, TexelWithoutASampleGetsTheLimit) {
  const HorizonScene scene(surface::makePlane(8, 8, 2, 2), flatRelief(8, 8), 0.5);
  const surface::SampleGrid none{2, 1, {surface::SurfaceSample{}, surface::SurfaceSample{}}};
  const horizon::AngleTable table =
      shootHorizons(scene.surface, scene.relief, scene.mesh, scene.scene, none, 3, 1.25);
  EXPECT_EQ(table.angles, std::vector<float>(6, 1.25F));
}

TEST(SurfaceHorizons, OneRayMeetsWhatAPacketMeets) {
  const HorizonScene scene(surface::makeTorus(30, 10, 66, 66), test::randomRelief(96, 66, 2, 7),
                           0.5);
  std::size_t hits = 0;
  for (int k = 0; k < 40; ++k) {
    const Vec3 direction = test::lightToward(9.0 * k, 7.0 * (k % 13) - 40);
    std::array<Vec3, RayPacket::size> origins{};
    RayPacket packet;
    for (std::size_t i = 0; i < RayPacket::size; ++i) {
      const auto turn = static_cast<double>(i);
      origins[i] = Vec3(45 * std::sin(turn), 20 * std::cos(3 * turn), 45 * std::cos(turn));
      packet.add(origins[i]);
    }
    packet.count = RayPacket::size - static_cast<std::size_t>(k % 3);
    const auto met = scene.scene.occluded(packet, direction);
    for (std::size_t i = 0; i < packet.count; ++i) {
      EXPECT_EQ(scene.scene.occluded(origins[i], direction), met[i]);
      EXPECT_EQ(scene.scene.nearest(origins[i], direction).has_value(), met[i]);
      hits += met[i] ? 1 : 0;
    }
    for (std::size_t i = packet.count; i < RayPacket::size; ++i) EXPECT_FALSE(met[i]);
  }
  EXPECT_GT(hits, 50U);
  EXPECT_LT(hits, 590U);
}

/// The stated search, one ray after the other.
double angleByOneRayAtATime(const HorizonScene& scene, const surface::SurfaceSample& sample,
                            double azimuth, double limit) {
  const surface::TexelFrame frame =
      surface::texelFrame(scene.surface.evaluate(sample), scene.relief.texelsPerUv());
  const surface::GridChart grid = scene.surface.grid().value();
  const Vec2 toward = Vec2(std::cos(azimuth), std::sin(azimuth)) / scene.relief.texelsPerUv() *
                      Vec2(grid.columns, grid.rows);
  const Facet facet = scene.mesh.facet(sample.face, sample.s, sample.t, toward);
  const Vec3 tangent = glm::normalize(std::cos(azimuth) * frame.px + std::sin(azimuth) * frame.py);
  const auto isFree = [&](double off) {
    const Vec3 direction = std::cos(off) * frame.normal + std::sin(off) * tangent;
    return !facet.facesAwayFrom(direction) &&
           !scene.scene.occluded(facet.rayOrigin(scene.mesh.rayOffset()), direction);
  };
  if (isFree(limit)) return limit;
  double blocked = limit;
  double free = limit - radians(4);
  for (; free > 0 && !isFree(free); free -= radians(4)) blocked = free;
  if (free <= 0 && !isFree(0)) return 0;
  free = std::max(free, 0.0);
  while (blocked - free > precision) {
    const double middle = (blocked + free) / 2;
    (isFree(middle) ? free : blocked) = middle;
  }
  return free;
}

TEST(SurfaceHorizons, SearchedTogetherAreThoseSearchedAlone) {
  const HorizonScene scene(surface::makeTorus(30, 10, 66, 66), test::randomRelief(96, 66, 3, 7),
                           0.5);
  constexpr int azimuths = 5;
  const horizon::AngleTable table = scene.shoot(20, 10, 19, 11, azimuths, pi / 2);
  std::size_t between = 0;
  for (int m = 0; m < azimuths; ++m) {
    for (int y = 0; y < 11; ++y) {
      for (int x = 0; x < 19; ++x) {
        const double alone = angleByOneRayAtATime(
            scene, sampleAt(scene.surface, scene.relief, Vec2(20 + x, 10 + y) + 0.5),
            2 * pi * m / azimuths, pi / 2);
        const float found = table.angles[static_cast<std::size_t>((m * 11 + y) * 19 + x)];
        ASSERT_EQ(found, static_cast<float>(alone)) << m << ' ' << x << ' ' << y;
        between += alone > 0 && alone < pi / 2 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(between, table.angles.size() / 4);
}

}  // namespace
}  // namespace gnomon::truth
