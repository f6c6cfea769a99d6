#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "surface/base_mesh.h"
#include "surface/cage/shapes.h"
#include "surface/closed_surface.h"
#include "surface/curvature.h"
#include "surface/face_grids.h"
#include "surface/mesh_file.h"
#include "surface/sample_grid.h"
#include "surface/test_surfaces.h"
#include "surface/texel_frame.h"

namespace gnomon::surface {
namespace {

TEST(BaseMesh, CountsAreExact) {
  const LimitSurface surface(makeSphere(10, 1, 1, 10, 12));
  for (const int cuts : {1, 2, 5}) {
    const BaseMesh mesh = makeBaseMesh(surface, {64, 64}, cuts);
    const auto n = static_cast<std::size_t>(cuts);
    EXPECT_EQ(mesh.vertices.size(), 120 * (n + 1) * (n + 1));
    EXPECT_EQ(mesh.triangleCount(), 120 * 2 * n * n);
    EXPECT_EQ(mesh.triangles.size(), 3 * mesh.triangleCount());
  }
}

TEST(BaseMesh, VerticesAreTheLimitSurface) {
  const LimitSurface surface(makeTorus(4, 1, 60, 60));
  const Vec2 texels(512, 256);
  const BaseMesh mesh = makeBaseMesh(surface, texels, 2);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 7) {
    const BaseVertex& vertex = mesh.vertices[i];
    const LimitPoint point = surface.evaluate(vertex.face, vertex.st.x, vertex.st.y);
    const TexelFrame frame = texelFrame(point, texels);
    EXPECT_EQ(vertex.frame.position, point.position);
    EXPECT_NEAR(glm::length(vertex.frame.normal), 1, 1e-14);
    EXPECT_EQ(vertex.frame.normal, frame.normal);
    EXPECT_EQ(vertex.frame.px, frame.px);
    EXPECT_EQ(vertex.frame.py, frame.py);
    EXPECT_EQ(vertex.frame.texel, frame.texel);
    // Curvature belongs to its own direction whatever the order.
    EXPECT_NEAR(normalCurvature(point, vertex.curvatures.v1), vertex.curvatures.k1, 1e-10);
    EXPECT_NEAR(normalCurvature(point, vertex.curvatures.v2), vertex.curvatures.k2, 1e-10);
  }
}

TEST(BaseMesh, TrianglesFaceOutwardAndTileTheFace) {
  const LimitSurface surface(cubeCage());
  constexpr int cuts = 4;
  const BaseMesh mesh = makeBaseMesh(surface, {16, 16}, cuts);
  double parameterArea = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const BaseVertex& a = mesh.vertices[mesh.triangles[i]];
    const BaseVertex& b = mesh.vertices[mesh.triangles[i + 1]];
    const BaseVertex& c = mesh.vertices[mesh.triangles[i + 2]];
    EXPECT_EQ(a.face, b.face);
    EXPECT_EQ(a.face, c.face);
    const Vec3 normal =
        glm::cross(b.frame.position - a.frame.position, c.frame.position - a.frame.position);
    EXPECT_GT(glm::dot(normal, a.frame.normal), 0);
    const Vec2 ab = b.st - a.st, ac = c.st - a.st;
    const double area = (ab.x * ac.y - ab.y * ac.x) / 2;
    EXPECT_NEAR(area, 0.5 / (cuts * cuts), 1e-15);
    parameterArea += area;
  }
  EXPECT_NEAR(parameterArea, 6, 1e-12);
}

TEST(BaseMesh, QuadrilateralsAreCutAlongTheRisingDiagonal) {
  const BaseMesh mesh = makeBaseMesh(LimitSurface(makePlane(1, 1, 1, 1)), {1, 1}, 1);
  std::multiset<std::pair<double, double>> corners;
  for (const std::uint32_t index : mesh.triangles) {
    corners.insert({mesh.vertices[index].st.x, mesh.vertices[index].st.y});
  }
  EXPECT_EQ(corners.count({0, 0}), 2u);
  EXPECT_EQ(corners.count({1, 1}), 2u);
  EXPECT_EQ(corners.count({1, 0}), 1u);
  EXPECT_EQ(corners.count({0, 1}), 1u);
}

TEST(BaseMesh, DirectionsOfAFaceAgree) {
  // A saddle-like patch, on which the larger curvature changes direction: without alignment
  // neighbouring vertices would swap theirs.
  std::array<Vec3, 16> points{};
  for (int i = 0; i < 16; ++i) {
    const double x = i % 4 - 1.5, y = i / 4 - 1.5;
    points[static_cast<std::size_t>(i)] = {x, y, 0.1 * x * x * x - 0.09 * y * y * y};
  }
  const LimitSurface surface(makeBezier(points, 2, 2));
  const BaseMesh mesh = makeBaseMesh(surface, {32, 32}, 8);
  int swapped = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const BaseVertex& vertex = mesh.vertices[i];
    const BaseVertex& first = mesh.vertices[i / 81 * 81];
    EXPECT_GE(glm::dot(vertex.curvatures.v1, first.curvatures.v1), 0);
    EXPECT_GE(glm::dot(vertex.curvatures.v2, first.curvatures.v2), 0);
    EXPECT_GE(std::abs(glm::dot(vertex.curvatures.v1, first.curvatures.v1)) + 1e-12,
              std::abs(glm::dot(vertex.curvatures.v1, first.curvatures.v2)));
    EXPECT_NEAR(glm::dot(vertex.curvatures.v1, vertex.curvatures.v2), 0, 1e-12);
    swapped += vertex.curvatures.k1 < vertex.curvatures.k2;
  }
  EXPECT_GT(swapped, 20);  // the test would be vacuous otherwise
}

TEST(BaseMesh, FirstVertexKeepsItsOrder) {
  const LimitSurface surface(cubeCage());
  const BaseMesh mesh = makeBaseMesh(surface, {16, 16}, 3);
  for (int face = 0; face < 6; ++face) {
    const BaseVertex& first = mesh.vertices[static_cast<std::size_t>(face) * 16];
    const PrincipalCurvatures principal = principalCurvatures(surface.evaluate(face, 0, 0));
    EXPECT_EQ(first.curvatures.v1, principal.v1);
    EXPECT_EQ(first.curvatures.k1, principal.k1);
  }
}

TEST(BaseMesh, RefusesSizes) {
  const LimitSurface surface(makePlane(1, 1, 64, 64));
  expectInputError(
      [&] {
        makeBaseMesh(surface, {1, 1}, 0);
      },
      {"subdivisions: 0 found", "1 to 1024"});
  expectInputError([&] { makeBaseMesh(surface, {1, 1}, 1025); }, {"subdivisions: 1025"});
  expectInputError([&] { makeBaseMesh(surface, {1, 1}, 1024); }, {"2^32"});
  EXPECT_THROW(makeBaseMesh(surface, {1, 1}, 1000), MemoryError);  // 0.9 TB
}

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

using Edge = std::pair<int, int>;

Edge edgeOf(const LimitSurface& surface, int face, std::size_t side) {
  const std::array<int, 4> corners = surface.corners(face);
  return std::minmax(corners.at(side % 4), corners.at((side + 1) % 4));
}

/// The ring of every edge, found by walking from edge to opposite edge until none is new.
std::map<Edge, int> ringsByWalking(const LimitSurface& surface) {
  std::map<Edge, std::vector<std::pair<int, std::size_t>>> facesOf;
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (std::size_t side = 0; side < 4; ++side) {
      facesOf[edgeOf(surface, face, side)].emplace_back(face, side);
    }
  }
  std::map<Edge, int> rings;
  int count = 0;
  for (const auto& entry : facesOf) {
    if (rings.contains(entry.first)) continue;
    std::vector<Edge> todo = {entry.first};
    while (!todo.empty()) {
      const Edge edge = todo.back();
      todo.pop_back();
      if (!rings.try_emplace(edge, count).second) continue;
      for (const auto& [face, side] : facesOf[edge])
        todo.push_back(edgeOf(surface, face, side + 2));
    }
    ++count;
  }
  return rings;
}

void expectAsByWalking(const LimitSurface& surface) {
  const EdgeRings rings = makeEdgeRings(surface);
  const std::map<Edge, int> expected = ringsByWalking(surface);
  std::map<int, int> same;  // expected number of each ring
  std::set<int> found;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const EdgeRings::Face& own = rings.faces[static_cast<std::size_t>(face)];
    for (const auto& [ring, side] : {std::pair{own.s, 0U}, {own.t, 1U}, {own.s, 2U}, {own.t, 3U}}) {
      const int walked = expected.at(edgeOf(surface, face, side));
      EXPECT_EQ(same.try_emplace(ring, walked).first->second, walked) << face << ", " << side;
      found.insert(walked);
    }
  }
  EXPECT_EQ(same.size(), found.size()) << "as many rings, not one the part of another";
  EXPECT_EQ(static_cast<std::size_t>(rings.count), same.size());
}

TEST(EdgeRings, AGridHasOneAColumnAndOneARow) {
  const LimitSurface surface(openGrid(5, 3));
  const EdgeRings rings = makeEdgeRings(surface);
  EXPECT_EQ(rings.count, 5 + 3);
  for (std::size_t face = 0; face < 15; ++face) {
    EXPECT_EQ(rings.faces[face].s, rings.faces[face % 5].s);
    EXPECT_EQ(rings.faces[face].t, rings.faces[face - face % 5].t);
  }
}

TEST(EdgeRings, ACubeHasThree) {
  EXPECT_EQ(makeEdgeRings(LimitSurface(cubeCage())).count, 3);
}

TEST(EdgeRings, OnTrianglesEachGoesRoundAVertex) {
  // Between the half of a side that is nearer to the far end and the next side's.
  Cage cage;
  cage.scheme = SubdivisionScheme::loop;
  cage.positions = {{8, 0, 0}, {-8, 0, 0}, {0, 8, 0}, {0, -8, 0}, {0, 0, 8}, {0, 0, -8}};
  cage.faceVertices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  cage.uvs = {{0, 0}, {1, 0}, {0, 1}};
  for (int corner = 0; corner < 24; ++corner) cage.faceUvs.push_back(corner % 3);
  const LimitSurface surface(cage);
  const EdgeRings rings = makeEdgeRings(surface);
  EXPECT_EQ(rings.count, 6);
  std::map<int, int> ringRound;
  for (std::size_t face = 0; face < rings.faces.size(); ++face) {
    const auto vertex = [&](std::size_t k) {
      return cage.faceVertices[face - face % 3 + (face + k) % 3];
    };
    const auto expectRing = [&](int round, int ring) {
      EXPECT_EQ(ringRound.try_emplace(round, ring).first->second, ring);
    };
    expectRing(vertex(1), rings.faces[face].s);
    expectRing(vertex(2), rings.faces[face].t);
  }
}

TEST(EdgeRings, AreThoseThatAWalkFromEdgeToOppositeEdgeFinds) {
  expectAsByWalking(LimitSurface(cubeCage()));
  expectAsByWalking(LimitSurface(openGrid(4, 7)));
  expectAsByWalking(LimitSurface(polesCage(5)));
  expectAsByWalking(LimitSurface(makeTorus(30, 10, 66, 58)));
  expectAsByWalking(LimitSurface(readMeshFile(GNOMON_SCENES "/meshes/spot_control_mesh.obj")));
}

TEST(SampleAreas, OfASpherePatchSumToItsArea) {
  // Between latitudes ±φ over longitude Λ: 2 R² Λ sin φ.
  const double radius = 2, longitude = 1.5, latitude = 1.2;
  const LimitSurface surface(makeSphere(radius, longitude, latitude, 20, 16));
  constexpr int cuts = 6;
  SampleGrid grid;
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (int i = 0; i < cuts * cuts; ++i) {
      grid.samples.push_back({face, static_cast<float>((i % cuts + 0.5) / cuts),
                              static_cast<float>((i / cuts + 0.5) / cuts)});
    }
  }
  grid.samples.emplace_back();  // no surface
  const std::vector<double> areas = sampleAreas(surface, grid, cuts);
  ASSERT_EQ(areas.size(), grid.samples.size());
  EXPECT_EQ(areas.back(), 0);
  double sum = 0;
  for (const double area : areas) sum += area;
  EXPECT_NEAR(sum, 2 * radius * radius * longitude * std::sin(latitude / 2), 1e-4);
}

TEST(SampleAreas, AreThoseOfTheGridAndFloatsHoldThem) {
  const LimitSurface surface(makeSphere(2, 1.5, 1.2, 20, 16));
  SampleGrid grid, shaken;
  for (int i = 0; i < 81; ++i) {
    const SurfaceSample sample{7, static_cast<float>((i % 9 + 0.5) / 9),
                               static_cast<float>((i / 9 + 0.5) / 9)};
    grid.samples.push_back(sample);
    shaken.samples.push_back({7, sample.s + (i % 2 == 0 ? 1e-5F : -1e-5F), sample.t - 1e-5F});
  }
  const std::vector<double> areas = sampleAreas(surface, grid, 9);
  EXPECT_EQ(sampleAreas(surface, shaken, 9), areas) << "as another mesh's rasteriser rounds them";
  EXPECT_NE(areas.front(), areas.back());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    EXPECT_EQ(static_cast<double>(static_cast<float>(areas[i])), areas[i]);
    const SurfaceSample& sample = grid.samples[i];
    const TangentPoint point = surface.tangentPoint(7, sample.s, sample.t);
    EXPECT_NEAR(areas[i] * 81 / glm::length(glm::cross(point.ds, point.dt)), 1, 1e-5);
  }
}

}  // namespace
}  // namespace gnomon::surface
