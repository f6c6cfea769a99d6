#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "surface/cage/cage.h"
#include "surface/cage/shapes.h"
#include "surface/face_grids.h"
#include "surface/test_surfaces.h"
#include "surface/texel_frame.h"
#include "surface/texture_layout.h"
#include "test_surfaces.h"

namespace gnomon::surface {
namespace {

/// A flat face spanned by a and b, whose uv map has the given derivatives.
LimitPoint flatPoint(const Vec3& a, const Vec3& b, Vec2 uvDs, Vec2 uvDt) {
  LimitPoint point{};
  point.position = {1, 2, 3};
  point.ds = a;
  point.dt = b;
  point.uv = {0.25, 0.5};
  point.uvDs = uvDs;
  point.uvDt = uvDt;
  return point;
}

void expectReconstructs(const TexelFrame& frame, const Vec3& light) {
  const LocalLight local = localLight(frame, light);
  // ℓ's length follows from σ: the tangential part of L is |ℓ| σ long.
  const double rise = glm::dot(light, frame.normal);
  const double run = glm::length(light - rise * frame.normal);
  const Vec2 l = local.direction * run / local.worldPerTexel;
  expectNear(l.x * frame.px + l.y * frame.py + rise * frame.normal, light, 1e-10, "light");
  EXPECT_NEAR(glm::length(local.direction), 1, 1e-14);
  EXPECT_NEAR(std::cos(local.azimuth()), local.direction.x, 1e-14);
  EXPECT_NEAR(std::sin(local.azimuth()), local.direction.y, 1e-14);
  EXPECT_NEAR(local.slope, rise / run, 1e-12 * (1 + std::abs(local.slope)));
}

TEST(TexelFrame, OfThePlane) {
  const LimitSurface surface(makePlane(4, 2, 8, 4));
  const TexelFrame frame = texelFrame(surface.evaluate(11, 0.5, 0.25), {128, 32});
  ASSERT_TRUE(frame.defined);
  expectNear(frame.px, {4.0 / 128, 0, 0}, 1e-15);
  expectNear(frame.py, {0, 2.0 / 32, 0}, 1e-15);
  expectNear(frame.normal, {0, 0, 1}, 1e-15);
  EXPECT_NEAR(frame.texel.x, 128 * 3.5 / 8, 1e-12);
  EXPECT_NEAR(frame.texel.y, 32 * 1.25 / 4, 1e-12);
}

TEST(TexelFrame, ObeysTheChainRule) {
  Random random(9);
  for (int i = 0; i < 500; ++i) {
    const LimitPoint point =
        flatPoint(random.vector(), random.vector(), {random(-1, 1), random(-1, 1)},
                  {random(-1, 1), random(-1, 1)});
    const Vec2 scale(random(1, 100), random(1, 100));
    const TexelFrame frame = texelFrame(point, scale);
    ASSERT_TRUE(frame.defined);
    const Vec2 xyS = point.uvDs * scale;
    const Vec2 xyT = point.uvDt * scale;
    const double size = 1 + glm::length(frame.px * xyS.x) + glm::length(frame.py * xyS.y);
    expectNear(frame.px * xyS.x + frame.py * xyS.y, point.ds, 1e-11 * size);
    expectNear(frame.px * xyT.x + frame.py * xyT.y, point.dt, 1e-11 * size);
  }
}

TEST(TexelFrame, ShearedAndStretchedClosedForm) {
  // P = a s + b t with x = 10 s + 5 t, y = 20 t: so s = x/10 - y/40, t = y/20.
  const Vec3 a(3, 0, 0), b(1, 2, 0);
  const TexelFrame frame = texelFrame(flatPoint(a, b, {10, 0}, {5, 20}), {1, 1});
  ASSERT_TRUE(frame.defined);
  expectNear(frame.px, a / 10.0, 1e-15);
  expectNear(frame.py, b / 20.0 - a / 40.0, 1e-15);
}

TEST(TexelFrame, MirroredTextureKeepsTheOutwardNormal) {
  const TexelFrame frame = texelFrame(flatPoint({2, 0, 0}, {0, 2, 0}, {-1, 0}, {0, 1}), {8, 8});
  ASSERT_TRUE(frame.defined);
  expectNear(frame.normal, {0, 0, 1}, 1e-15);
  expectNear(frame.px, {-0.25, 0, 0}, 1e-15);
  EXPECT_LT(glm::dot(glm::cross(frame.px, frame.py), frame.normal), 0);  // left-handed tangents
  expectReconstructs(frame, glm::normalize(Vec3(0.3, 0.5, 0.7)));
  EXPECT_LT(localLight(frame, glm::normalize(Vec3(1, 0, 1))).direction.x, 0);
}

TEST(TexelFrame, DegenerateIsUndefinedAndKeepsTheSurfacesNormal) {
  const Vec3 a(1, 0, 0), b(0, 1, 0);
  for (const LimitPoint& point :
       {flatPoint(a, b, {0, 0}, {0, 1}), flatPoint(a, b, {1, 2}, {2, 4}),
        flatPoint(a, 2.0 * a, {1, 0}, {0, 1}), flatPoint({}, b, {1, 0}, {0, 1})}) {
    const TexelFrame frame = texelFrame(point, {64, 64});
    EXPECT_FALSE(frame.defined);
    EXPECT_EQ(frame.px, Vec3(0));
    EXPECT_EQ(frame.py, Vec3(0));
    EXPECT_EQ(frame.normal, outwardNormal(point));
    EXPECT_EQ(frame.position, Vec3(1, 2, 3));
    EXPECT_EQ(frame.texel, Vec2(16, 32));
  }
  EXPECT_FALSE(texelFrame(flatPoint(a, b, {1, 0}, {0, 1}), {0, 64}).defined);
}

TEST(LocalLight, ReconstructsTheLightInAnyFrame) {
  Random random(10);
  for (int i = 0; i < 500; ++i) {
    const TexelFrame frame =
        texelFrame(flatPoint(random.vector(), random.vector(), {random(0.2, 1), random(-1, 1)},
                             {random(-1, 1), random(-1, 1)}),
                   {32, 64});
    // Skip frames so thin that rounding, not the formula, would be tested.
    const double sine = glm::length(glm::cross(frame.px, frame.py)) /
                        (glm::length(frame.px) * glm::length(frame.py));
    if (!(sine > 0.01)) continue;
    expectReconstructs(frame, glm::normalize(random.vector()));
  }
}

TEST(LocalLight, ClosedFormOnAnAnisotropicFrame) {
  // One texel is 3 wide and 1 high: a light at 45° in the world stands at (1/3, 1) in texels.
  const TexelFrame frame = texelFrame(flatPoint({3, 0, 0}, {0, 1, 0}, {1, 0}, {0, 1}), {1, 1});
  const LocalLight local = localLight(frame, glm::normalize(Vec3(1, 1, 1)));
  EXPECT_NEAR(local.azimuth(), std::atan2(1, 1.0 / 3), 1e-15);
  EXPECT_NEAR(local.slope, 1 / std::sqrt(2), 1e-15);
  EXPECT_NEAR(local.worldPerTexel, std::sqrt(2) / std::hypot(1.0 / 3, 1), 1e-14);
}

TEST(LocalLight, ClosedFormOnAShearedFrame) {
  // P_x = (1,0,0), P_y = (1,1,0): L's tangential part (0,1,0) is P_y - P_x.
  const TexelFrame frame = texelFrame(flatPoint({1, 0, 0}, {1, 1, 0}, {1, 0}, {0, 1}), {1, 1});
  const LocalLight local = localLight(frame, glm::normalize(Vec3(0, 1, 2)));
  EXPECT_NEAR(local.azimuth(), 3 * pi / 4, 1e-15);
  EXPECT_NEAR(local.slope, 2, 1e-14);
  EXPECT_NEAR(local.worldPerTexel, 1 / std::sqrt(2), 1e-15);
}

TEST(LocalLight, AlongTheNormal) {
  const TexelFrame frame = texelFrame(flatPoint({3, 1, 0}, {0, 1, 2}, {1, 0}, {0, 1}), {1, 1});
  for (const double side : {1.0, -1.0}) {
    const LocalLight local = localLight(frame, side * frame.normal);
    EXPECT_EQ(local.direction, Vec2(1, 0));
    EXPECT_EQ(local.azimuth(), 0);
    EXPECT_TRUE(std::isinf(local.slope));
    EXPECT_EQ(std::signbit(local.slope), side < 0);
    EXPECT_DOUBLE_EQ(local.worldPerTexel, glm::length(frame.px));
  }
}

TEST(LocalLight, BelowTheHorizonHasNegativeSlope) {
  const TexelFrame frame = texelFrame(flatPoint({1, 0, 0}, {0, 1, 0}, {1, 0}, {0, 1}), {1, 1});
  EXPECT_NEAR(localLight(frame, glm::normalize(Vec3(1, 0, -2))).slope, -2, 1e-14);
}

/// One square, its corners at these places of the map.
LimitSurface squareOf(const std::vector<Vec2>& uvs) {
  Cage cage = openGrid(1, 1);
  cage.uvs = uvs;
  cage.faceUvs = {0, 1, 2, 3};
  return LimitSurface(cage);
}

TEST(FaceTexels, AreTheLongestLinesAndTheArea) {
  // A trapezoid: 4 along its base, 2 along its top, sides 3 and √(2² + 3²).
  const LimitSurface surface = squareOf({{0, 0}, {4, 0}, {2, 3}, {0, 3}});
  const FaceTexels face = faceTexels(surface, Vec2(10, 10), 0);
  EXPECT_NEAR(face.s, 40, 1e-9);
  EXPECT_NEAR(face.t, 10 * std::sqrt(13), 1e-9);
  EXPECT_NEAR(face.area, 900, 1e-9);
  EXPECT_NEAR(longestEdgeTexels(surface, Vec2(10, 10)), 40, 1e-9);
  EXPECT_NEAR(longestEdgeTexels(surface, Vec2(1, 10)), std::sqrt(4 + 900), 1e-9);
}

TEST(FaceTexels, NoLineInsideIsLonger) {
  const LimitSurface surface = squareOf({{0, 0}, {4, 1}, {3, 5}, {-1, 2}});
  const FaceTexels face = faceTexels(surface, Vec2(1), 0);
  for (double at = 0; at <= 1; at += 0.125) {
    EXPECT_LE(glm::length(surface.tangentPoint(0, 0.5, at).uvDs), face.s + 1e-12);
    EXPECT_LE(glm::length(surface.tangentPoint(0, at, 0.5).uvDt), face.t + 1e-12);
  }
}

TEST(FaceTexels, MirroredFacesHaveThePositiveArea) {
  const LimitSurface surface = squareOf({{4, 0}, {0, 0}, {0, 3}, {4, 3}});
  EXPECT_NEAR(faceTexels(surface, Vec2(1), 0).area, 12, 1e-12);
}

/// Squares of area 1 in the world, apart from each other, each with the texture coordinates of its
/// four corners.
Cage squares(const std::vector<std::array<Vec2, 4>>& uvs) {
  Cage cage;
  constexpr std::array corners = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  for (std::size_t face = 0; face < uvs.size(); ++face) {
    for (std::size_t k = 0; k < 4; ++k) {
      const int vertex = static_cast<int>(cage.positions.size());
      cage.positions.emplace_back(2.0 * static_cast<double>(face) + corners.at(k).x,
                                  corners.at(k).y, 0);
      cage.uvs.push_back(uvs[face].at(k));
      cage.faceVertices.push_back(vertex);
      cage.faceUvs.push_back(vertex);
    }
  }
  return cage;
}

std::array<Vec2, 4> box(Vec2 low, Vec2 high) {
  return {low, Vec2(high.x, low.y), high, Vec2(low.x, high.y)};
}

std::array<Vec2, 4> mirrored(const std::array<Vec2, 4>& corners) {
  return {corners[1], corners[0], corners[3], corners[2]};
}

TextureLayout layoutOf(const Cage& cage) {
  return textureLayout(LimitSurface(cage));
}

/// Triangles of a Loop cage, apart from each other.
Cage triangles(const std::vector<TextureTriangle>& uvs) {
  Cage cage;
  cage.scheme = SubdivisionScheme::loop;
  for (std::size_t face = 0; face < uvs.size(); ++face) {
    constexpr std::array corners = {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
    for (std::size_t k = 0; k < 3; ++k) {
      const int vertex = static_cast<int>(cage.positions.size());
      cage.positions.emplace_back(2.0 * static_cast<double>(face) + corners.at(k).x,
                                  corners.at(k).y, 0);
      cage.uvs.push_back(uvs[face].at(k));
      cage.faceVertices.push_back(vertex);
      cage.faceUvs.push_back(vertex);
    }
  }
  return cage;
}

/// A strip of four squares whose texture folds back in its middle.
Cage folded() {
  Cage cage = openGrid(4, 1);
  // The texture goes to the right for two squares and back for two.
  for (Vec2& uv : cage.uvs) uv.x = 2 - std::abs(uv.x - 2);
  return cage;
}

TEST(TextureLayout, TwoSquaresHalfOverEachOtherShareHalf) {
  const auto layout = layoutOf(squares({box({0, 0}, {1, 1}), box({0.5, 0}, {1.5, 1})}));
  EXPECT_FALSE(layout.isOneToOne);
  EXPECT_NEAR(layout.sharedArea, 0.5, 1e-12);
  EXPECT_EQ(layout.charts, (std::vector{1, 2}));
}

TEST(TextureLayout, ASmallSquareInALargeOneSharesItsAreaAndAllOfItsOwn) {
  // (1/16 + 1) of two squares.
  const auto layout = layoutOf(squares({box({0, 0}, {1, 1}), box({0.5, 0.25}, {0.75, 0.5})}));
  EXPECT_NEAR(layout.sharedArea, (1.0 / 16 + 1) / 2, 1e-12);
}

TEST(TextureLayout, AreaUnderSeveralFacesCountsOnce) {
  // The first lies under the halves of two others, that lie over each other in a quarter.
  const auto layout =
      layoutOf(squares({box({0, 0}, {1, 1}), box({0, 0}, {0.5, 1}), box({0.25, 0}, {0.75, 1})}));
  EXPECT_NEAR(layout.sharedArea, (0.75 + 1 + 1) / 3, 1e-12);
}

TEST(TextureLayout, AMirroredHalfSharesAll) {
  const auto layout = layoutOf(squares({box({0, 0}, {1, 1}), mirrored(box({0, 0}, {1, 1}))}));
  EXPECT_NEAR(layout.sharedArea, 1, 1e-12);
  EXPECT_EQ(layout.chartCount, 2);
}

TEST(TextureLayout, AStripThatFoldsBackSharesAllAndHasTwoCharts) {
  const auto layout = layoutOf(folded());
  EXPECT_NEAR(layout.sharedArea, 1, 1e-12);
  EXPECT_EQ(layout.charts, (std::vector{1, 1, 2, 2}));
}

TEST(TextureLayout, StackedFacesOfACubeShareAllAndAreChartsOfTheirOwn) {
  const auto layout = layoutOf(cubeCage());
  EXPECT_NEAR(layout.sharedArea, 1, 1e-9);
  EXPECT_EQ(layout.charts, (std::vector{1, 2, 3, 4, 5, 6}));
}

TEST(TextureLayout, AGridIsOneChart) {
  const auto layout = layoutOf(openGrid(5, 3));
  EXPECT_TRUE(layout.isOneToOne);
  EXPECT_EQ(layout.sharedArea, 0);
  EXPECT_EQ(layout.charts, std::vector<int>(15, 1));
}

TEST(TextureLayout, ChartsWhoseBordersTouchShareNothing) {
  // Numbers that binary fractions do not hold, and corners in the middle of another's edge.
  const auto layout =
      layoutOf(squares({box({0.1, 0.1}, {0.3, 0.7}), box({0.3, 0.1}, {0.9, 0.2}),
                        mirrored(box({0.3, 0.2}, {0.6, 0.7})), box({0.1, 0.7}, {0.6, 0.9})}));
  EXPECT_TRUE(layout.isOneToOne);
  EXPECT_EQ(layout.sharedArea, 0);
  EXPECT_EQ(layout.chartCount, 4);
}

TEST(TextureLayout, TouchingAlongSlantedEdgesIsDecidedExactly) {
  // Fans about a point: neighbours have an edge in common, of any slope. Every triangle by itself.
  Random random(3);
  std::vector<TextureTriangle> fan;
  std::vector<Vec2> rim;
  constexpr int count = 64;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * pi * (k + 0.5 * random(0, 1)) / count;
    rim.push_back(Vec2(0.3, 0.7) + random(0.1, 1) * Vec2(std::cos(angle), std::sin(angle)));
  }
  for (std::size_t k = 0; k < count; ++k)
    fan.push_back({Vec2(0.3, 0.7), rim[k], rim[(k + 1) % count]});
  EXPECT_TRUE(layoutOf(triangles(fan)).isOneToOne);
  for (TextureTriangle& triangle : fan) {
    for (Vec2& corner : triangle) corner *= 1e-20;
  }
  EXPECT_TRUE(layoutOf(triangles(fan)).isOneToOne);
  fan.push_back({Vec2(0), 1e-25 * Vec2(1, 0), 1e-25 * Vec2(0, 1)});
  fan.back()[0] = fan[0][0] + Vec2(1e-24, 0);
  fan.back()[1] = fan[0][0] + Vec2(2e-24, 0);
  fan.back()[2] = fan[0][0] + Vec2(1e-24, 1e-24);
  EXPECT_FALSE(layoutOf(triangles(fan)).isOneToOne);
}

TEST(TextureLayout, AHairOverTheEdgeIsAnOverlapAndAHairBeforeItIsNone) {
  constexpr double hair = 1e-300;
  const TextureTriangle upper = {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
  const auto lower = [](double apex) {
    return TextureTriangle{Vec2(0.25, -1), Vec2(0.75, -1), Vec2(0.5, apex)};
  };
  EXPECT_TRUE(layoutOf(triangles({upper, lower(0)})).isOneToOne);
  EXPECT_TRUE(layoutOf(triangles({upper, lower(-hair)})).isOneToOne);
  EXPECT_FALSE(layoutOf(triangles({upper, lower(hair)})).isOneToOne);
}

TEST(TextureLayout, OrientationIsExactWhereRoundingLosesTheSign) {
  // Kettner et al. 2008: points near a line, one unit in the last place apart.
  const double step = std::ldexp(1.0, -53);
  for (int j = 0; j < 32; ++j) {
    for (int i = 0; i < 32; ++i) {
      const Vec2 near(0.5 + i * step, 0.5 + j * step);
      const int expected = j > i ? 1 : (j < i ? -1 : 0);
      EXPECT_EQ(orientation({12, 12}, {24, 24}, near), expected);
      EXPECT_EQ(orientation({24, 24}, {12, 12}, near), -expected);
    }
  }
}

TEST(TextureLayout, AConcaveQuadrilateralIsCutInside) {
  const std::array dart = {Vec2(0, 0), Vec2(1, 0.4), Vec2(2, 0), Vec2(1, 2)};  // reflex at 1
  double area = 0;
  for (const auto& [a, b, c] : trianglesOf(dart)) {
    area += ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }
  EXPECT_NEAR(area, 1.6, 1e-12);
  // What fills the notch touches it.
  const auto layout =
      layoutOf(squares({dart, {Vec2(0, 0), Vec2(1, -1), Vec2(2, 0), Vec2(1, 0.4)}}));
  EXPECT_TRUE(layout.isOneToOne);
}

TEST(TextureLayout, AFaceWithoutAreaInTheTextureIsUnderNone) {
  const auto layout = layoutOf(
      squares({box({0, 0}, {1, 1}), {Vec2(0.5, 0), Vec2(0.5, 1), Vec2(0.5, 1), Vec2(0.5, 0)}}));
  EXPECT_TRUE(layout.isOneToOne);
}

TEST(TextureLayout, RandomTrianglesAgreeWithCountingAtManyPoints) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    std::vector<TextureTriangle> all;
    const double size = 0.08 * seed;
    while (all.size() < 40) {
      const Vec2 at(random(0, 1), random(0, 1));
      const auto near = [&] { return at + size * Vec2(random(-1, 1), random(-1, 1)); };
      TextureTriangle triangle = {near(), near(), near()};
      const auto& [a, b, c] = triangle;
      const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      if (std::abs(twice) < 0.2 * size * size) continue;
      all.push_back(triangle);
    }
    // Each has the same area in the world, so that its share of points in others counts alike.
    double expected = 0;
    for (const TextureTriangle& own : all) {
      int covered = 0;
      int points = 0;
      constexpr int side = 60;
      for (int j = 0; j < side; ++j) {
        for (int i = 0; i + j < side; ++i) {
          const double u = (i + 1.0 / 3) / side;
          const double v = (j + 1.0 / 3) / side;
          const Vec2 place = own[0] + u * (own[1] - own[0]) + v * (own[2] - own[0]);
          ++points;
          covered += std::any_of(all.begin(), all.end(), [&](const TextureTriangle& other) {
            const bool isTurned = orientation(other[0], other[1], other[2]) < 0;
            return &other != &own &&
                   isInside(isTurned ? TextureTriangle{other[0], other[2], other[1]} : other,
                            place);
          });
        }
      }
      expected += static_cast<double>(covered) / points / static_cast<double>(all.size());
    }
    const TextureLayout layout = layoutOf(triangles(all));
    EXPECT_NEAR(layout.sharedArea, expected, 2e-3) << "seed " << seed;
    EXPECT_GT(layout.sharedArea, 0.01);
    EXPECT_EQ(layout.chartCount, 40);
  }
}

TEST(TextureLayout, NoChartOverlapsItself) {
  // A spiral ramp whose texture turns round a point more than once.
  Cage cage = openGrid(40, 1);
  for (std::size_t i = 0; i < cage.uvs.size(); ++i) {
    const Vec2 at = cage.uvs[i];
    const double angle = 0.4 * at.x;  // 16 radians in all
    cage.uvs[i] = (2 - at.y) * Vec2(std::cos(angle), std::sin(angle));
  }
  const LimitSurface surface(cage);
  const TextureLayout layout = textureLayout(surface);
  EXPECT_FALSE(layout.isOneToOne);
  EXPECT_EQ(layout.chartCount, 3);
  for (int chart = 1; chart <= layout.chartCount; ++chart) {
    std::vector<std::array<Vec2, 4>> own;
    for (int face = 0; face < surface.faceCount(); ++face) {
      if (layout.charts[static_cast<std::size_t>(face)] == chart)
        own.push_back(surface.cornerUvs(face));
    }
    EXPECT_TRUE(layoutOf(squares(own)).isOneToOne) << chart;
  }
}

}  // namespace
}  // namespace gnomon::surface
