// Loop's limit surface of triangles: against the masks of the paper, linear precision and finite
// differences.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "surface/limit_surface.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

/// Closed, eight faces, six vertices of valence 4; each face has its own corner of the texture.
Cage octahedron() {
  Cage cage;
  cage.scheme = SubdivisionScheme::loop;
  cage.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  cage.faceVertices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  cage.uvs = {{0, 0}, {1, 0}, {0, 1}};
  for (int face = 0; face < 8; ++face) {
    for (const int uv : {0, 1, 2}) cage.faceUvs.push_back(uv);
  }
  return cage;
}

/// The border-less middle of a regular triangulation: (columns + 1) × (rows + 1) vertices at
/// (i, j), each square cut along its (0,0)-(1,1) diagonal; inner vertices have valence 6. uv = xy.
Cage triangleGrid(int columns, int rows) {
  const Cage quads = openGrid(columns, rows);
  Cage cage;
  cage.scheme = SubdivisionScheme::loop;
  cage.positions = quads.positions;
  cage.uvs = quads.uvs;
  for (int face = 0; face < quads.faceCount(); ++face) {
    const int* v = &quads.faceVertices[static_cast<std::size_t>(4 * face)];
    for (const int k : {0, 1, 2, 0, 2, 3}) cage.faceVertices.push_back(v[k]);
  }
  cage.faceUvs = cage.faceVertices;
  return cage;
}

TEST(LoopSurface, ATriangleIsThreeFaces) {
  const LimitSurface surface(octahedron());
  EXPECT_EQ(surface.faceCount(), 24);
  EXPECT_EQ(surface.vertexCount(), 6 + 12 + 8);
  EXPECT_FALSE(surface.grid());
  // Euler: 26 vertices, 48 sides, 24 faces; every side is shared by two.
  std::map<std::pair<int, int>, int> sides;
  for (int face = 0; face < 24; ++face) {
    const auto corners = surface.corners(face);
    for (std::size_t k = 0; k < 4; ++k) ++sides[std::minmax(corners[k], corners[(k + 1) % 4])];
  }
  EXPECT_EQ(sides.size(), 48U);
  for (const auto& [side, faces] : sides) EXPECT_EQ(faces, 2);
}

/// The limit of a vertex is (1 - n χ) v + χ Σ neighbours, 1 / χ = n + 3 / (8 β), with Loop's
/// β = (5/8 - (3/8 + cos(2π/n) / 4)²) / n.
Vec3 limitOfVertex(const Vec3& vertex, const std::vector<Vec3>& neighbours) {
  const auto n = static_cast<double>(neighbours.size());
  const double inner = 3.0 / 8 + std::cos(2 * pi / n) / 4;
  const double beta = (5.0 / 8 - inner * inner) / n;
  const double chi = 1 / (n + 3 / (8 * beta));
  Vec3 sum(0);
  for (const Vec3& neighbour : neighbours) sum += neighbour;
  return (1 - n * chi) * vertex + chi * sum;
}

TEST(LoopSurface, VerticesGoWhereThePapersMaskSends) {
  const LimitSurface surface(octahedron());
  for (int face = 0; face < surface.faceCount(); ++face) {
    const int vertex = surface.corners(face)[0];
    ASSERT_LT(vertex, 6);
    const Cage cage = octahedron();
    std::vector<Vec3> neighbours;
    for (int other = 0; other < 6; ++other) {
      if (other / 2 != vertex / 2) {
        neighbours.push_back(cage.positions[static_cast<std::size_t>(other)]);
      }
    }
    expectNear(surface.evaluate(face, 0, 0).position,
               limitOfVertex(cage.positions[static_cast<std::size_t>(vertex)], neighbours), 1e-6);
  }
  // A regular vertex, among heights at random.
  Cage grid = triangleGrid(6, 6);
  Random random(3);
  for (Vec3& position : grid.positions) position += random.vector(0.3);
  const LimitSurface bumpy(grid);
  const int middle = 3 * 7 + 3;
  std::vector<Vec3> neighbours;
  for (const int offset : {1, 8, 7, -1, -8, -7}) {
    neighbours.push_back(grid.positions[static_cast<std::size_t>(middle + offset)]);
  }
  const Vec3 expected = limitOfVertex(grid.positions[middle], neighbours);
  int met = 0;
  for (int face = 0; face < bumpy.faceCount(); ++face) {
    if (bumpy.corners(face)[0] != middle) continue;
    expectNear(bumpy.evaluate(face, 0, 0).position, expected, 1e-12);
    ++met;
  }
  EXPECT_EQ(met, 6);
}

TEST(LoopSurface, AFlatGridStaysItselfWithItsTexture) {
  Cage cage = triangleGrid(6, 6);
  for (Vec3& position : cage.positions) {
    position = {2 * position.x + position.y, position.y, 0.5 * position.x};
  }
  const LimitSurface surface(cage);
  int inner = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (const Vec2 st : {Vec2(0.2, 0.7), Vec2(0.9, 0.3), Vec2(1, 1)}) {
      const LimitPoint point = surface.evaluate(face, st.x, st.y);
      if (glm::length(point.uv - Vec2(3)) > 1.5) continue;  // clear of the border's rules
      ++inner;
      const Vec2 uv = point.uv;
      expectNear(point.position, {2 * uv.x + uv.y, uv.y, 0.5 * uv.x}, 1e-12);
      const auto image = [](Vec2 d) { return Vec3(2 * d.x + d.y, d.y, 0.5 * d.x); };
      expectNear(point.ds, image(point.uvDs), 1e-12);
      expectNear(point.dt, image(point.uvDt), 1e-12);
      EXPECT_GT(glm::dot(outwardNormal(point), Vec3(-0.5, 0.5, 2)), 0);
    }
  }
  EXPECT_GT(inner, 100);
}

TEST(LoopSurface, DerivativesAreThoseOfThePosition) {
  const LimitSurface surface(octahedron());
  constexpr double step = 1e-5;
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (const Vec2 st : {Vec2(0.31, 0.62), Vec2(0.7, 0.15), Vec2(0.55, 0.9)}) {
      const auto at = [&](double s, double t) { return surface.evaluate(face, s, t); };
      const LimitPoint point = at(st.x, st.y);
      const LimitPoint right = at(st.x + step, st.y), left = at(st.x - step, st.y);
      const LimitPoint up = at(st.x, st.y + step), down = at(st.x, st.y - step);
      expectNear(point.ds, (right.position - left.position) / (2 * step), 1e-8, "ds");
      expectNear(point.dt, (up.position - down.position) / (2 * step), 1e-8, "dt");
      expectNear(point.dss, (right.ds - left.ds) / (2 * step), 1e-7, "dss");
      expectNear(point.dst, (up.ds - down.ds) / (2 * step), 1e-7, "dst");
      expectNear(point.dst, (right.dt - left.dt) / (2 * step), 1e-7, "dst");
      expectNear(point.dtt, (up.dt - down.dt) / (2 * step), 1e-7, "dtt");
    }
  }
}

TEST(LoopSurface, FacesMeetAlongSharedSides) {
  const LimitSurface surface(octahedron());
  std::map<std::pair<int, int>, Vec3> middles;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const auto corners = surface.corners(face);
    const std::array<Vec2, 4> at = {Vec2(0.5, 0), Vec2(1, 0.5), Vec2(0.5, 1), Vec2(0, 0.5)};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 middle = surface.evaluate(face, at[k].x, at[k].y).position;
      const auto [entry, first] =
          middles.try_emplace(std::minmax(corners[k], corners[(k + 1) % 4]), middle);
      if (!first) expectNear(middle, entry->second, 1e-9);
    }
    expectFinite(surface.evaluate(face, 0, 0));
    EXPECT_GT(glm::dot(outwardNormal(surface.evaluate(face, 0.5, 0.5)),
                       surface.evaluate(face, 0.5, 0.5).position),
              0);
  }
}

}  // namespace
}  // namespace gnomon::surface
