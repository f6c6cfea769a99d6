#include "surface/limit_face.h"

#include <algorithm>
#include <vector>

#include "surface/cage/shapes.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

Cage randomSpline() {
  Random random(3);
  std::vector<Vec3> points;
  for (int k = 0; k < 42; ++k) points.push_back(random.vector(20) + Vec3(300, -200, 100));
  return makeBSpline(points, 7, 6);
}

/// An open grid, whose border faces are regular too, bent at random.
Cage bentGrid() {
  Cage cage = openGrid(4, 3);
  Random random(5);
  for (Vec3& position : cage.positions) position += random.vector(0.4);
  return cage;
}

Cage creasedGrid() {
  Cage cage = bentGrid();
  cage.creases.push_back({{6, 7}, 2.5});
  return cage;
}

Cage triangles() {
  Cage cage;
  cage.positions = {{0, 0, 0}, {2, 0, 1}, {2, 2, 0}, {0, 2, 1}};
  cage.faceVertices = {0, 1, 2, 0, 2, 3};
  cage.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  cage.faceUvs = cage.faceVertices;
  cage.scheme = SubdivisionScheme::loop;
  return cage;
}

const std::vector<double> parameters = {0, 1e-9, 0.1, 0.25, 1.0 / 3, 0.5, 0.7, 0.9999, 1};

void expectSame(const TangentPoint& value, const TangentPoint& expected, double tolerance) {
  expectNear(value.position, expected.position, tolerance, "position");
  expectNear(value.ds, expected.ds, tolerance, "ds");
  expectNear(value.dt, expected.dt, tolerance, "dt");
  EXPECT_EQ(value.uv, expected.uv);
  EXPECT_EQ(value.uvDs, expected.uvDs);
  EXPECT_EQ(value.uvDt, expected.uvDt);
}

/// Every face by rows, against the surface point by point.
void expectRowsOf(const Cage& cage, double tolerance) {
  const LimitSurface surface(cage);
  std::vector<TangentPoint> points(parameters.size());
  for (int face = 0; face < surface.faceCount(); ++face) {
    const LimitFace rows(surface, face, parameters.size() * parameters.size());
    for (const double t : parameters) {
      rows.row(t, parameters, points);
      for (std::size_t k = 0; k < points.size(); ++k) {
        expectSame(points[k], surface.evaluate(face, parameters[k], t), tolerance);
      }
    }
  }
}

// Coordinates of some 300 round at 6e-14; a few operations make ten times that.
TEST(LimitFace, ARegularFaceIsItsPolynomial) {
  for (const Cage& cage : {randomSpline(), bentGrid(), makeTorus(300, 100, 60, 60)}) {
    EXPECT_TRUE(LimitSurface(cage).isBicubic(0));
    expectRowsOf(cage, 1e-12);
  }
}

TEST(LimitFace, OtherFacesAreTheSurfaceItself) {
  for (const Cage& cage : {cubeCage(), triangles()}) {
    EXPECT_FALSE(LimitSurface(cage).isBicubic(0));
    expectRowsOf(cage, 0);
  }
  const LimitSurface creased(creasedGrid());
  EXPECT_FALSE(creased.isBicubic(0));
  expectRowsOf(creasedGrid(), 1e-12);
}

void expectSecondDerivatives(const LimitPoint& value, const LimitPoint& expected,
                             double tolerance) {
  expectNear(value.dss, expected.dss, tolerance, "dss");
  expectNear(value.dst, expected.dst, tolerance, "dst");
  expectNear(value.dtt, expected.dtt, tolerance, "dtt");
}

TEST(LimitFace, HasTheSurfacesSecondDerivatives) {
  for (const Cage& cage : {randomSpline(), bentGrid(), cubeCage(), triangles()}) {
    const LimitSurface surface(cage);
    const auto count = static_cast<std::size_t>(surface.faceCount());
    const std::vector<LimitFace> faces =
        limitFaces(surface, count * parameters.size() * parameters.size());
    ASSERT_EQ(faces.size(), count);
    for (int face = 0; face < surface.faceCount(); ++face) {
      const double tolerance = surface.isBicubic(face) ? 1e-11 : 0;
      for (const double s : parameters) {
        for (const double t : parameters) {
          const LimitPoint value = faces[static_cast<std::size_t>(face)].evaluate(s, t);
          const LimitPoint expected = surface.evaluate(face, s, t);
          expectSame(value, expected, tolerance);
          expectSecondDerivatives(value, expected, tolerance);
        }
      }
    }
  }
}

TEST(LimitFace, ForFewPointsItIsTheSurfaceItself) {
  const LimitSurface surface(randomSpline());
  std::vector<TangentPoint> points(parameters.size());
  LimitFace(surface, 3, 4).row(0.3, parameters, points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    expectSame(points[k], surface.evaluate(3, parameters[k], 0.3), 0);
  }
}

TEST(LimitFace, TangentPointsAreThoseOfEvaluateToTheBit) {
  for (const Cage& cage : {randomSpline(), bentGrid(), creasedGrid(), cubeCage(), triangles()}) {
    const LimitSurface surface(cage);
    for (int face = 0; face < surface.faceCount(); ++face) {
      for (const double s : parameters) {
        for (const double t : parameters) {
          expectSame(surface.tangentPoint(face, s, t), surface.evaluate(face, s, t), 0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::surface
