#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "surface/base_mesh.h"
#include "surface/cage/shapes.h"
#include "surface/curvature.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

/// A point of the torus (M + m cos ψ)(sin λ, ·, cos λ), m sin ψ, seen through the sheared
/// parameters λ = a s + b t, ψ = c s + d t with ad > bc.
LimitPoint torusPoint(double major, double minor, double longitude, double turn, double a, double b,
                      double c, double d) {
  const double sl = std::sin(longitude), cl = std::cos(longitude);
  const double st = std::sin(turn), ct = std::cos(turn);
  const double r = major + minor * ct;
  const Vec3 p(r * sl, minor * st, r * cl);
  const Vec3 pl(r * cl, 0, -r * sl);
  const Vec3 pt(-minor * st * sl, minor * ct, -minor * st * cl);
  const Vec3 pll(-r * sl, 0, -r * cl);
  const Vec3 plt(-minor * st * cl, 0, minor * st * sl);
  const Vec3 ptt(-minor * ct * sl, -minor * st, -minor * ct * cl);
  LimitPoint point{};
  point.position = p;
  point.ds = a * pl + c * pt;
  point.dt = b * pl + d * pt;
  point.dss = a * a * pll + 2 * a * c * plt + c * c * ptt;
  point.dst = a * b * pll + (a * d + b * c) * plt + c * d * ptt;
  point.dtt = b * b * pll + 2 * b * d * plt + d * d * ptt;
  return point;
}

LimitPoint randomPoint(Random& random) {
  LimitPoint point{};
  for (Vec3* vector : {&point.position, &point.ds, &point.dt, &point.dss, &point.dst, &point.dtt}) {
    *vector = random.vector();
  }
  return point;
}

TEST(PrincipalCurvatures, TorusThroughShearedParameters) {
  const double major = 3, minor = 0.8;
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const double longitude = random(-pi, pi);
    const double turn = random(-pi, pi);
    const double b = random(-1, 1), c = random(-1, 1);
    const LimitPoint point = torusPoint(major, minor, longitude, turn, 1.5, b, c, 1.5);
    const PrincipalCurvatures principal = principalCurvatures(point);
    EXPECT_NEAR(principal.k1, 1 / minor, 1e-12);
    EXPECT_NEAR(principal.k2, std::cos(turn) / (major + minor * std::cos(turn)), 1e-12);
    // v1 runs round the tube, v2 round the axis.
    const Vec3 round(std::cos(longitude), 0, -std::sin(longitude));
    EXPECT_NEAR(glm::dot(principal.v1, round), 0, 1e-11);
    EXPECT_NEAR(std::abs(glm::dot(principal.v2, round)), 1, 1e-11);
  }
}

TEST(PrincipalCurvatures, AreTheTextbookFormula) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const LimitPoint p = randomPoint(random);
    const Vec3 n = glm::normalize(glm::cross(p.ds, p.dt));
    const double E = glm::dot(p.ds, p.ds), F = glm::dot(p.ds, p.dt), G = glm::dot(p.dt, p.dt);
    const double e = glm::dot(p.dss, n), f = glm::dot(p.dst, n), g = glm::dot(p.dtt, n);
    const double H = (e * G - 2 * f * F + g * E) / (2 * (E * G - F * F));
    const double K = (e * g - f * f) / (E * G - F * F);
    const PrincipalCurvatures principal = principalCurvatures(p);
    const double scale = 1 + std::abs(principal.k1) + std::abs(principal.k2);
    EXPECT_NEAR((principal.k1 + principal.k2) / 2, -H, 1e-9 * scale);
    EXPECT_NEAR(principal.k1 * principal.k2, K, 1e-9 * scale * scale);
    EXPECT_GE(principal.k1, principal.k2);
  }
}

TEST(PrincipalCurvatures, DirectionsAreOrthonormalTangents) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const LimitPoint p = randomPoint(random);
    const PrincipalCurvatures principal = principalCurvatures(p);
    const Vec3 n = outwardNormal(p);
    EXPECT_NEAR(glm::length(principal.v1), 1, 1e-14);
    EXPECT_NEAR(glm::length(principal.v2), 1, 1e-14);
    EXPECT_NEAR(glm::dot(principal.v1, principal.v2), 0, 1e-13);
    EXPECT_NEAR(glm::dot(principal.v1, n), 0, 1e-12);
    expectNear(glm::cross(principal.v1, principal.v2), n, 1e-12);
  }
}

TEST(NormalCurvature, IsEulersFormula) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const LimitPoint p = randomPoint(random);
    const PrincipalCurvatures principal = principalCurvatures(p);
    const double angle = random(-pi, pi);
    const double c = std::cos(angle), s = std::sin(angle);
    const Vec3 tangent = c * principal.v1 + s * principal.v2;
    const Vec3 direction = random(0.1, 5) * tangent + random(-2, 2) * outwardNormal(p);
    const double scale = 1 + std::abs(principal.k1) + std::abs(principal.k2);
    EXPECT_NEAR(normalCurvature(p, direction), principal.k1 * c * c + principal.k2 * s * s,
                1e-11 * scale);
  }
}

TEST(NormalCurvature, IsMinusTheRatioOfTheFundamentalForms) {
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const LimitPoint p = randomPoint(random);
    const Vec3 n = outwardNormal(p);
    const double a = random(-1, 1), b = random(-1, 1);
    const Vec3 direction = a * p.ds + b * p.dt;
    const double second =
        a * a * glm::dot(p.dss, n) + 2 * a * b * glm::dot(p.dst, n) + b * b * glm::dot(p.dtt, n);
    const double expected = -second / glm::dot(direction, direction);
    EXPECT_NEAR(normalCurvature(p, direction), expected, 1e-9 * (1 + std::abs(expected)));
  }
}

TEST(NormalCurvature, IsTheBendOfANormalSection) {
  // A curve on the surface through p: κ = -P''·n / |P'|², here by differences on a limit surface.
  const LimitSurface surface(cubeCage());
  const LimitPoint p = surface.evaluate(0, 0.4, 0.6);
  const double h = 1e-4;
  const double a = 0.8, b = -0.6;
  const Vec3 before = surface.evaluate(0, 0.4 - a * h, 0.6 - b * h).position;
  const Vec3 after = surface.evaluate(0, 0.4 + a * h, 0.6 + b * h).position;
  const Vec3 direction = (after - before) / (2 * h);
  const double bend = glm::dot((after - 2.0 * p.position + before) / (h * h), outwardNormal(p));
  EXPECT_NEAR(normalCurvature(p, direction), -bend / glm::dot(direction, direction), 1e-6);
  EXPECT_GT(normalCurvature(p, direction), 0.1);  // convex is positive
}

/// S T by its eigenvectors, and by differences of the normal along a straight line of parameters:
/// dn(a P_s + b P_t) = a n_s + b n_t.
TEST(NormalTurn, IsTheShapeOperatorAndTheNormalsOwnChange) {
  Random random(9);
  for (int i = 0; i < 200; ++i) {
    const LimitPoint point = torusPoint(5, 2, random(-3, 3), random(-3, 3), 0.3, 0.1, -0.1, 0.2);
    const PrincipalCurvatures k = principalCurvatures(point);
    const Vec3 n = outwardNormal(point);
    const Vec3 direction = random.vector();
    const Vec3 t = glm::normalize(direction - glm::dot(direction, n) * n);
    const Vec3 turn = applyShapeOperator(point, direction);
    expectNear(turn, k.k1 * glm::dot(t, k.v1) * k.v1 + k.k2 * glm::dot(t, k.v2) * k.v2, 1e-12);
    EXPECT_NEAR(glm::dot(t, turn), normalCurvature(point, direction), 1e-12);
  }
  const LimitPoint here = torusPoint(5, 2, 0.3, 0.8, 1, 0, 0, 1);
  const double step = 1e-5;
  const Vec3 ahead = outwardNormal(torusPoint(5, 2, 0.3 + 2 * step, 0.8 + step, 1, 0, 0, 1));
  const Vec3 behind = outwardNormal(torusPoint(5, 2, 0.3 - 2 * step, 0.8 - step, 1, 0, 0, 1));
  const Vec3 along = 2.0 * here.ds + here.dt;
  expectNear(applyShapeOperator(here, along), (ahead - behind) / (2 * step) / glm::length(along),
             1e-8);
  expectNear(applyShapeOperator(here, outwardNormal(here)), Vec3(0), 0);
}

TEST(PrincipalCurvatures, ABowlIsNegative) {
  // z = (x² + 2 y²) / 2 seen from above bends toward its normal.
  LimitPoint point{};
  point.ds = {1, 0, 0};
  point.dt = {0, 1, 0};
  point.dss = {0, 0, 1};
  point.dtt = {0, 0, 2};
  const PrincipalCurvatures principal = principalCurvatures(point);
  EXPECT_EQ(principal.k1, -1);
  EXPECT_EQ(principal.k2, -2);
  expectNear(principal.v1, {1, 0, 0}, 1e-15);
}

TEST(PrincipalCurvatures, UmbilicsAreFinite) {
  // A sphere of radius R about the origin: P_ss = -P where parameters are arc angles at the
  // equator.
  const double R = 2.5;
  LimitPoint sphere{};
  sphere.position = {0, 0, R};
  sphere.ds = {R, 0, 0};
  sphere.dt = {0, R, 0};
  sphere.dss = {0, 0, -R};
  sphere.dtt = {0, 0, -R};
  const PrincipalCurvatures principal = principalCurvatures(sphere);
  EXPECT_DOUBLE_EQ(principal.k1, 1 / R);
  EXPECT_DOUBLE_EQ(principal.k2, 1 / R);
  expectNear(principal.v1, {1, 0, 0}, 1e-15);
  EXPECT_DOUBLE_EQ(normalCurvature(sphere, {0.3, -2, 7}), 1 / R);

  // Rounding may not choose the direction: a plane far from the origin, turned at random.
  const LimitSurface plane(makePlane(3, 2, 5, 4));
  for (int face = 0; face < plane.faceCount(); ++face) {
    const LimitPoint point = plane.evaluate(face, 0.3, 0.7);
    const PrincipalCurvatures flat = principalCurvatures(point);
    EXPECT_NEAR(flat.k1, 0, 1e-12);
    EXPECT_NEAR(flat.k2, 0, 1e-12);
    expectNear(flat.v1, glm::normalize(point.ds), 1e-12);
  }
}

TEST(PrincipalCurvatures, DegeneratePointsAreZero) {
  LimitPoint point{};
  point.dss = {0, 0, 1};
  for (const Vec3& dt : {Vec3(0), Vec3(2, 0, 0), Vec3(1e-200, 1e-200, 0)}) {
    point.ds = {1, 0, 0};
    point.dt = dt;
    const PrincipalCurvatures principal = principalCurvatures(point);
    for (const double value : {principal.k1, principal.k2, glm::length(principal.v1),
                               glm::length(principal.v2), normalCurvature(point, {1, 1, 1})}) {
      EXPECT_TRUE(std::isfinite(value));
    }
  }
  point.dt = {2, 0, 0};
  EXPECT_EQ(principalCurvatures(point).k1, 0);
  EXPECT_EQ(principalCurvatures(point).v1, Vec3(0));
  point.dt = {0, 1, 0};
  EXPECT_EQ(normalCurvature(point, {0, 0, 1}), 0);  // no tangential part
  EXPECT_EQ(normalCurvature(point, {0, 0, 0}), 0);
}

/// ∫ K dA and ∫ |K| dA by the midpoint rule.
struct TotalCurvature {
  double signedSum = 0, absoluteSum = 0, area = 0;
};

TotalCurvature totalCurvature(const LimitSurface& surface, int cuts) {
  TotalCurvature total;
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (int i = 0; i < cuts; ++i) {
      for (int j = 0; j < cuts; ++j) {
        const LimitPoint point = surface.evaluate(face, (i + 0.5) / cuts, (j + 0.5) / cuts);
        const PrincipalCurvatures principal = principalCurvatures(point);
        const double area = glm::length(glm::cross(point.ds, point.dt)) / (cuts * cuts);
        total.signedSum += principal.k1 * principal.k2 * area;
        total.absoluteSum += std::abs(principal.k1 * principal.k2) * area;
        total.area += area;
      }
    }
  }
  return total;
}

TEST(GaussBonnet, Torus) {
  // χ = 0; the outer half alone has 4π, the inner -4π. Area 4π² M m.
  const LimitSurface surface(makeTorus(3, 1, 64, 60));
  const TotalCurvature total = totalCurvature(surface, 4);
  EXPECT_NEAR(total.signedSum, 0, 1e-6);
  EXPECT_NEAR(total.absoluteSum, 8 * pi, 0.01);
  EXPECT_NEAR(total.area, 4 * pi * pi * 3, 1e-3);
}

TEST(GaussBonnet, ClosedCageOfValenceThree) {
  const LimitSurface surface(cubeCage());
  const double coarse = totalCurvature(surface, 16).signedSum - 4 * pi;
  const double fine = totalCurvature(surface, 64).signedSum - 4 * pi;
  EXPECT_LT(std::abs(fine), 1e-3);
  EXPECT_LT(std::abs(fine), std::abs(coarse));
}

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
