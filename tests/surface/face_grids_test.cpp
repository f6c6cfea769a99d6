#include "surface/face_grids.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "surface/cage/shapes.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

/// A grid of vertices over every face of a surface, by their positions.
struct Grids {
  FaceGrids grids;
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> border;  ///< vertices on a face's border

  Grids(const LimitSurface& surface, int columns, int rows)
      : grids({evenLines(columns - 1), evenLines(rows - 1)},
              std::vector<FaceLines>(static_cast<std::size_t>(surface.faceCount()), {0, 1})) {
    for (int face = 0; face < surface.faceCount(); ++face) {
      for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
          if (i == 0 || j == 0 || i == columns - 1 || j == rows - 1) {
            border.push_back(static_cast<std::uint32_t>(positions.size()));
          }
          const Vec2 place = Vec2(i, j) / Vec2(columns - 1, rows - 1);
          positions.push_back(surface.evaluate(face, place.x, place.y).position);
        }
      }
    }
  }
};

/// For each border vertex the first one at its place, found by comparing all with all.
std::map<std::size_t, std::size_t> firstByPlace(const Grids& grids, double tolerance) {
  std::map<std::size_t, std::size_t> first;
  for (const std::uint32_t vertex : grids.border) {
    first[vertex] = vertex;
    for (const std::uint32_t other : grids.border) {
      if (glm::length(grids.positions[vertex] - grids.positions[other]) < tolerance) {
        first[vertex] = other;
        break;
      }
    }
  }
  return first;
}

/// @returns how many vertices were visited
std::size_t expectVisits(const Cage& cage, int columns, int rows) {
  const LimitSurface surface(cage);
  const Grids grids(surface, columns, rows);
  // Neighbours lie far more than a thousandth of a unit apart; near an extraordinary vertex an
  // evaluation strays by 1e-5.
  const auto expected = firstByPlace(grids, 1e-3);
  std::map<std::size_t, std::size_t> visited;
  forEachSharedVertex(surface, grids.grids, [&](std::size_t first, std::size_t vertex) {
    EXPECT_TRUE(visited.emplace(vertex, first).second) << vertex << " twice";
  });
  for (const auto& [vertex, first] : expected) {
    if (vertex == first) {
      EXPECT_EQ(visited.count(vertex), 0U) << vertex << " is the first at its place";
    } else {
      EXPECT_EQ(visited.count(vertex), 1U) << vertex;
      EXPECT_EQ(visited[vertex], first) << vertex;
    }
  }
  return visited.size();
}

TEST(SharedVertices, OfAClosedCubeAreAllThatTheFirstFacesHaveAlready) {
  // 12 edges of 3 inner vertices that two faces have, 8 corners that three have.
  EXPECT_EQ(expectVisits(cubeCage(), 5, 5), 12U * 3 + 8 * 2);
  EXPECT_EQ(expectVisits(cubeCage(), 2, 2), 8U * 2);
}

TEST(SharedVertices, OfATorusRunAcrossBothOfItsSeams) {
  // 58 × 60 faces, twice as many edges, as many corners, each corner in four faces.
  EXPECT_EQ(expectVisits(makeTorus(30, 10, 58, 60), 3, 3), 58U * 60 * (2 * 1 + 3));
}

TEST(SharedVertices, OfAGridMayBeMoreAlongOneSideThanAlongTheOther) {
  // 2 inner edges across 5 rows' worth, 3 along: (columns - 1) rows + columns (rows - 1) edges.
  const std::size_t upright = 3 * 3;      // edges along t, each with 7 - 2 inner vertices
  const std::size_t level = 4 * 2;        // edges along s, each with 4 - 2 inner vertices
  const std::size_t inner = 3 * 2;        // corners of four faces
  const std::size_t rim = 2 * 3 + 2 * 2;  // corners of two
  EXPECT_EQ(expectVisits(makePlane(12, 9, 4, 3), 4, 7), upright * 5 + level * 2 + inner * 3 + rim);
}

TEST(SharedVertices, OfAnOpenPatchLeaveItsRimAlone) {
  EXPECT_EQ(expectVisits(openGrid(3, 3), 4, 4), 12U * 2 + 4 * 3 + 8);
  EXPECT_EQ(expectVisits(openGrid(1, 1), 6, 6), 0U);
}

TEST(SharedVertices, AreListedForEveryVertex) {
  const LimitSurface surface(cubeCage());
  const Grids grids(surface, 4, 4);
  const auto first = firstVertices(surface, grids.grids);
  ASSERT_EQ(first.size(), grids.positions.size());
  std::set<std::uint32_t> kept;
  for (std::size_t v = 0; v < first.size(); ++v) {
    EXPECT_LE(first[v], v);
    EXPECT_EQ(first[first[v]], first[v]);
    EXPECT_LT(glm::length(grids.positions[v] - grids.positions[first[v]]), 1e-4);
    kept.insert(first[v]);
  }
  EXPECT_EQ(kept.size(), 6U * 2 * 2 + 12 * 2 + 8);
}

TEST(FaceGrids, NumberVerticesFaceByFaceAndRowByRow) {
  const FaceGrids grids({{0, 1}, {0, 0.25, 1}}, {{0, 1}, {1, 1}});
  ASSERT_EQ(grids.faces().size(), 2U);
  const FaceGrid& second = grids.faces()[1];
  EXPECT_EQ(second.firstVertex, 6U);
  EXPECT_EQ(second.vertex(2, 1), 6U + 3 + 2);
  EXPECT_EQ(grids.vertexCount(), 15U);
  EXPECT_EQ(grids.triangleCount(), 4U + 8);
  EXPECT_EQ(grids.sLines(second), grids.tLines(grids.faces()[0]));
}

TEST(FaceGrids, TrianglesOfBothDiagonalsTileTheFaceCounterClockwise) {
  const FaceGrids grids = FaceGrids::even(2, 3);
  for (const Diagonal diagonal : {Diagonal::fromOrigin, Diagonal::acrossOrigin}) {
    const auto triangles = gridTriangles(grids, diagonal);
    ASSERT_EQ(triangles.size(), 3 * grids.triangleCount());
    const auto place = [](std::uint32_t v) { return Vec2(v % 16 % 4, v % 16 / 4); };
    double area = 0;
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      EXPECT_EQ(triangles[i] / 16, triangles[i + 1] / 16);
      EXPECT_EQ(triangles[i] / 16, triangles[i + 2] / 16);
      const Vec2 a = place(triangles[i + 1]) - place(triangles[i]);
      const Vec2 b = place(triangles[i + 2]) - place(triangles[i]);
      EXPECT_EQ(a.x * b.y - a.y * b.x, 1);
      area += 0.5;
      // The cut is the only side that is longer than 1.
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 side = place(triangles[i + (k + 1) % 3]) - place(triangles[i + k]);
        if (glm::length(side) < 1.1) continue;
        EXPECT_EQ(side.x * side.y, diagonal == Diagonal::fromOrigin ? 1 : -1);
      }
    }
    EXPECT_EQ(area, 2 * 9);
  }
}

TEST(SharedVertices, NeighboursAgreeToTheBitOnceTheFirstIsCopied) {
  const LimitSurface surface(cubeCage());
  Grids grids(surface, 6, 6);
  forEachSharedVertex(surface, grids.grids, [&](std::size_t first, std::size_t vertex) {
    EXPECT_LT(glm::length(grids.positions[vertex] - grids.positions[first]), 1e-4);
    grids.positions[vertex] = grids.positions[first];
  });
  std::set<std::tuple<double, double, double>> places;
  for (const Vec3& p : grids.positions) places.emplace(p.x, p.y, p.z);
  EXPECT_EQ(places.size(), 6U * 4 * 4 + 12 * 4 + 8);
}

}  // namespace
}  // namespace gnomon::surface
