#include "surface/vertex_curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "surface/cage/shapes.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

/// The largest difference of normal curvatures in four directions from the limit surface's, away
/// from an open surface's border, where a vertex has half a ring.
double worstError(const LimitSurface& surface, int subdivisions, double margin = -1) {
  const BaseMesh mesh = makeBaseMesh(surface, Vec2(64), subdivisions, CurvatureSource::vertices);
  double worst = 0;
  for (const BaseVertex& vertex : mesh.vertices) {
    const Vec2 uv = vertex.frame.texel / 64.0;
    if (std::min(std::min(uv.x, uv.y), std::min(1 - uv.x, 1 - uv.y)) < margin) continue;
    const LimitPoint point = surface.evaluate(vertex.face, vertex.st.x, vertex.st.y);
    for (const double turn : {0.0, 0.25, 0.5, 0.75}) {
      const Vec3 direction =
          std::cos(turn * pi) * vertex.curvatures.v1 + std::sin(turn * pi) * vertex.curvatures.v2;
      const double c = std::cos(turn * pi);
      const double s = std::sin(turn * pi);
      const double estimate = vertex.curvatures.k1 * c * c + vertex.curvatures.k2 * s * s;
      worst = std::max(worst, std::abs(estimate - normalCurvature(point, direction)));
    }
  }
  return worst;
}

TEST(EstimatedCurvatures, AreExactOnSpheresAndCylinders) {
  // But for what the shapes themselves err, and the regularisation.
  EXPECT_LT(worstError(LimitSurface(makeSphere(20, 1.5, 1, 20, 14)), 1), 1e-3 / 20);
  EXPECT_LT(worstError(LimitSurface(makeCylinder(20, 2 * pi, 30, 60, 7)), 1), 1e-3 / 20);
  EXPECT_LT(worstError(LimitSurface(makePlane(4, 3, 5, 2)), 3), 1e-9);
}

TEST(EstimatedCurvatures, ComeNearTheLimitSurfacesAsEdgesShorten) {
  // A patch whose curvature changes.
  std::array<Vec3, 16> points;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      points.at(static_cast<std::size_t>(4 * j + i)) =
          Vec3(i, j, 0.4 * i * (3 - i) * (1 + 0.3 * j) + 0.2 * j * j);
    }
  }
  const LimitSurface surface(makeBezier(points, 6, 6));
  const double coarse = worstError(surface, 1, 0.01);
  const double fine = worstError(surface, 8, 0.01);
  EXPECT_GT(coarse, 1e-3);  // an estimate it is
  EXPECT_LT(fine, coarse / 4);
}

TEST(EstimatedCurvatures, AreConvexPositiveWithDirectionsInTheTangentPlane) {
  const LimitSurface surface(makeTorus(30, 10, 66, 66));
  const BaseMesh mesh = makeBaseMesh(surface, Vec2(64), 1, CurvatureSource::vertices);
  for (const BaseVertex& vertex : mesh.vertices) {
    EXPECT_NEAR(std::max(vertex.curvatures.k1, vertex.curvatures.k2), 0.1, 1e-3);
    EXPECT_NEAR(glm::dot(vertex.curvatures.v1, vertex.frame.normal), 0, 1e-12);
    EXPECT_NEAR(glm::dot(vertex.curvatures.v1, vertex.curvatures.v2), 0, 1e-12);
    EXPECT_NEAR(glm::length(vertex.curvatures.v1), 1, 1e-12);
  }
}

TEST(EstimatedCurvatures, FacesAgreeAtCommonVerticesAndDegenerateOnesAreZero) {
  const LimitSurface surface(cubeCage());
  const BaseMesh mesh = makeBaseMesh(surface, Vec2(64), 1, CurvatureSource::vertices);
  for (const BaseVertex& a : mesh.vertices) {
    EXPECT_TRUE(std::isfinite(a.curvatures.k1 + a.curvatures.k2));
    for (const BaseVertex& b : mesh.vertices) {
      if (glm::length(a.frame.position - b.frame.position) > 1e-6) continue;
      EXPECT_NEAR(a.curvatures.k1 + a.curvatures.k2, b.curvatures.k1 + b.curvatures.k2, 1e-6);
    }
  }
  BaseMesh flat;
  flat.vertices.resize(3);
  flat.triangles = {0, 1, 2};
  for (const PrincipalCurvatures& at : estimatedCurvatures(flat, std::array{0U, 1U, 2U})) {
    EXPECT_EQ(at.k1, 0);
    EXPECT_EQ(at.v1, Vec3(0));
  }
}

}  // namespace
}  // namespace gnomon::surface
