#include "surface/texture_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "surface/cage/cage.h"
#include "test_surfaces.h"

namespace gnomon::surface {
namespace {

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
