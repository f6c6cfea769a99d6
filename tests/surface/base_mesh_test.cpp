#include "surface/base_mesh.h"

#include <cmath>
#include <set>

#include "surface/cage/shapes.h"
#include "surface/curvature.h"
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

}  // namespace
}  // namespace gnomon::surface
