#include "surface/edge_rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "surface/cage/shapes.h"
#include "surface/mesh_file.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

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

}  // namespace
}  // namespace gnomon::surface
