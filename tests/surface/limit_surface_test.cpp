#include <algorithm>
#include <set>
#include <vector>

#include "common/parallel.h"
#include "surface/cage/shapes.h"
#include "surface/limit_surface.h"
#include "surface/plain_subdivision.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

/// A closed cage with vertices of valence 3, 4 and 5: the cube with its top extruded thrice and
/// one side as well.
Cage branchedCage() {
  Cage cage = cubeCage();
  const auto extrude = [&cage](std::size_t face, const Vec3& by) {
    const int first = static_cast<int>(cage.positions.size());
    std::array<int, 4> base{};
    for (std::size_t k = 0; k < 4; ++k) {
      base[k] = cage.faceVertices[4 * face + k];
      cage.positions.push_back(cage.positions[static_cast<std::size_t>(base[k])] + by);
      cage.faceVertices[4 * face + k] = first + static_cast<int>(k);
    }
    for (int k = 0; k < 4; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const int next = (k + 1) % 4;
      for (const int v : {base[i], base[static_cast<std::size_t>(next)], first + next, first + k}) {
        cage.faceVertices.push_back(v);
      }
      for (int corner = 0; corner < 4; ++corner) cage.faceUvs.push_back(corner);
    }
  };
  extrude(0, {0.2, 0, 1.5});
  extrude(2, {1.5, 0.3, 0});
  extrude(4, {0, 1, 0.4});
  return cage;
}

double worstAgainst(const PlainSubdivision& plain, const LimitSurface& surface) {
  const std::vector<Vec3> limits = plain.limits();
  double worst = 0;
  for (const auto& face : plain.faces) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 position = surface.evaluate(face.cageFace, face.st[k].x, face.st[k].y).position;
      const Vec3& expected = limits[static_cast<std::size_t>(face.vertices[k])];
      worst = std::max(worst, glm::length(position - expected));
    }
  }
  return worst;
}

TEST(LimitSurface, AgreesWithPlainSubdivision) {
  // Outside the last isolated rings, which 6 steps do not reach, agreement is exact.
  for (const Cage& cage : {cubeCage(), branchedCage()}) {
    PlainSubdivision plain(cage);
    for (int i = 0; i < 6; ++i) plain.step();
    EXPECT_LT(worstAgainst(plain, LimitSurface(cage)), 1e-13);
  }
}

/// Largest errors at distances of 2⁻⁷ to 2⁻¹³ of a face from a corner of the cage.
struct CapErrors {
  double outside = 0;  ///< farther than 2⁻¹⁰
  double slide = 0;    ///< within: in all, nearly all of it along the surface
  double lift = 0;     ///< within: along the normal
};

CapErrors errorsBeside(const Cage& cage, int corner) {
  const LimitSurface surface(cage);
  PlainSubdivision plain(cage);
  CapErrors worst;
  for (int level = 1; level <= 13; ++level) {
    plain.step();
    const double size = std::ldexp(1, -level);
    if (level >= 3) plain.crop(cage, corner, 4 * size);
    if (level < 7) continue;
    const std::vector<Vec3> limits = plain.limits();
    PlainSubdivision sound = plain;
    sound.crop(cage, corner, 2 * size);
    for (const auto& face : sound.faces) {
      for (std::size_t k = 0; k < 4; ++k) {
        const LimitPoint point = surface.evaluate(face.cageFace, face.st[k].x, face.st[k].y);
        const Vec3 error = point.position - limits[static_cast<std::size_t>(face.vertices[k])];
        const double length = glm::length(error);
        if (level <= 10) worst.outside = std::max(worst.outside, length);
        worst.slide = std::max(worst.slide, length);
        worst.lift = std::max(worst.lift, std::abs(glm::dot(error, outwardNormal(point))));
      }
    }
  }
  return worst;
}

TEST(LimitSurface, ErrsAsDocumentedBesideExtraordinaryVertices) {
  const Cage cage = branchedCage();  // faces of about 1.5
  std::set<long> seen;
  for (int corner = 0; corner < static_cast<int>(cage.positions.size()); ++corner) {
    const long valence = std::count(cage.faceVertices.begin(), cage.faceVertices.end(), corner);
    if (!seen.insert(valence).second) continue;
    const CapErrors worst = errorsBeside(cage, corner);
    EXPECT_LT(worst.outside, 1e-13) << valence;
    if (valence == 4) {
      EXPECT_LT(worst.slide, 1e-13);
      continue;
    }
    EXPECT_LT(worst.slide, 1e-3) << valence;
    EXPECT_LT(worst.lift, 1e-6) << valence;
    EXPECT_GT(worst.slide, 1e-8) << valence;  // the approximated part was reached
  }
  EXPECT_TRUE(seen.count(3) && seen.count(4) && seen.count(5) && seen.count(6));
}

TEST(LimitSurface, CubeCornerLimitIsTheClosedForm) {
  // (9 v + 4 Σe + Σf) / 24 with v = Σe = -Σf = (1, 1, 1).
  const LimitSurface surface(cubeCage());
  const LimitPoint point = surface.evaluate(0, 1, 1);
  expectNear(point.position, Vec3(0.5), 1e-12);
  expectNear(outwardNormal(point), glm::normalize(Vec3(1)), 1e-7);
}

TEST(LimitSurface, NormalsOfAClosedCageFaceOutward) {
  const LimitSurface surface(cubeCage());
  for (int face = 0; face < 6; ++face) {
    for (const double s : {0.0, 0.3, 1.0}) {
      for (const double t : {0.0, 0.6, 1.0}) {
        const LimitPoint point = surface.evaluate(face, s, t);
        EXPECT_GT(glm::dot(outwardNormal(point), glm::normalize(point.position)), 0.9);
      }
    }
  }
}

TEST(LimitSurface, DerivativesAreThoseOfThePosition) {
  const Cage cage = branchedCage();
  const LimitSurface surface(cage);
  Random random(1);
  const double h = 1e-4;
  for (int face = 0; face < surface.faceCount(); ++face) {
    // Inside one polynomial piece: away from the dyadic lines about extraordinary corners.
    const double s = 0.5 + random(0.05, 0.2);
    const double t = 0.25 + random(0.05, 0.2);
    const auto p = [&](double i, double j) {
      return surface.evaluate(face, s + i * h, t + j * h).position;
    };
    const LimitPoint point = surface.evaluate(face, s, t);
    expectNear(point.ds, (p(1, 0) - p(-1, 0)) / (2 * h), 1e-7, "ds");
    expectNear(point.dt, (p(0, 1) - p(0, -1)) / (2 * h), 1e-7, "dt");
    expectNear(point.dss, (p(1, 0) - 2.0 * p(0, 0) + p(-1, 0)) / (h * h), 1e-6, "dss");
    expectNear(point.dtt, (p(0, 1) - 2.0 * p(0, 0) + p(0, -1)) / (h * h), 1e-6, "dtt");
    expectNear(point.dst, (p(1, 1) - p(1, -1) - p(-1, 1) + p(-1, -1)) / (4 * h * h), 1e-6, "dst");
  }
}

TEST(LimitSurface, FacesMeetAlongSharedEdges) {
  const LimitSurface surface(branchedCage());
  const auto onEdge = [](std::size_t corner, double r) {
    const std::array<Vec2, 4> start = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    return glm::mix(start[corner], start[(corner + 1) % 4], r);
  };
  std::map<std::pair<int, int>, std::pair<int, std::size_t>> seen;
  int shared = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const auto corners = surface.corners(face);
    for (std::size_t k = 0; k < 4; ++k) {
      seen[{corners[k], corners[(k + 1) % 4]}] = {face, k};
      const auto other = seen.find({corners[(k + 1) % 4], corners[k]});
      if (other == seen.end()) continue;
      ++shared;
      for (const double r : {0.1, 0.25, 0.5, 0.8}) {
        const Vec2 here = onEdge(k, r);
        const Vec2 there = onEdge(other->second.second, 1 - r);
        const LimitPoint a = surface.evaluate(face, here.x, here.y);
        const LimitPoint b = surface.evaluate(other->second.first, there.x, there.y);
        expectNear(a.position, b.position, 1e-12);
        expectNear(outwardNormal(a), outwardNormal(b), 1e-12);
      }
    }
  }
  EXPECT_EQ(shared, 2 * surface.faceCount());  // Euler: a closed quad mesh has 2 F edges
}

TEST(LimitSurface, SharpCreasesKeepTheCube) {
  Cage cage = cubeCage();
  for (int face = 0; face < 6; ++face) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t first = 4 * static_cast<std::size_t>(face);
      cage.creases.push_back(
          {{cage.faceVertices[first + k], cage.faceVertices[first + (k + 1) % 4]}, 10});
    }
  }
  const LimitSurface surface(cage);
  expectNear(surface.evaluate(0, 1, 1).position, Vec3(1), 1e-12);
  expectNear(surface.evaluate(0, 0.5, 1).position, Vec3(0, 1, 1), 1e-12);
  EXPECT_NEAR(surface.evaluate(0, 0.3, 0.8).position.z, 1, 1e-12);
}

TEST(LimitSurface, SharpnessGrowsTowardTheCube) {
  const auto cornerHeight = [](double sharpness) {
    Cage cage = cubeCage();
    if (sharpness > 0) cage.sharpVertices.push_back({7, sharpness});
    return LimitSurface(cage).evaluate(0, 1, 1).position.z;
  };
  EXPECT_NEAR(cornerHeight(0), 0.5, 1e-12);
  EXPECT_GT(cornerHeight(1), cornerHeight(0) + 0.05);
  EXPECT_GT(cornerHeight(3), cornerHeight(1) + 0.05);
  EXPECT_NEAR(cornerHeight(10), 1, 1e-12);
  EXPECT_NEAR(cornerHeight(50), 1, 1e-12);
}

TEST(LimitSurface, SupportBorderLeavesTheInnerFacesInOrder) {
  Cage cage = openGrid(6, 5);
  cage.border = CageBorder::support;
  cage.grid = GridChart{4, 3};
  const LimitSurface surface(cage);
  ASSERT_EQ(surface.faceCount(), 12);
  ASSERT_TRUE(surface.grid().has_value());
  EXPECT_EQ(surface.grid()->columns, 4);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const LimitPoint point = surface.evaluate(row * 4 + column, 0.25, 0.5);
      expectNear(point.position, {column + 1.25, row + 1.5, 0}, 1e-13);
    }
  }
  EXPECT_EQ(surface.corners(0), (std::array{8, 9, 16, 15}));
  EXPECT_EQ(surface.vertexCount(), 42);
}

TEST(LimitSurface, EdgesAndCornersInterpolatesTheBorder) {
  const LimitSurface surface(openGrid(3, 3));
  EXPECT_EQ(surface.faceCount(), 9);
  EXPECT_FALSE(surface.grid().has_value());
  expectNear(surface.evaluate(0, 0, 0).position, {0, 0, 0}, 1e-13);
  expectNear(surface.evaluate(8, 1, 1).position, {3, 3, 0}, 1e-13);
  EXPECT_NEAR(surface.evaluate(1, 0.3, 0).position.y, 0, 1e-13);
}

TEST(LimitSurface, TextureCoordinatesAreBilinear) {
  Cage cage = openGrid(1, 1);
  cage.uvs = {{0.1, 0.2}, {0.9, 0.3}, {0.2, 1.1}, {1.3, 0.8}};  // corners 0, 1, 3, 2
  const LimitSurface surface(cage);
  const double s = 0.3;
  const double t = 0.6;
  const LimitPoint point = surface.evaluate(0, s, t);
  const Vec2 expected = (1 - s) * (1 - t) * cage.uvs[0] + s * (1 - t) * cage.uvs[1] +
                        s * t * cage.uvs[3] + (1 - s) * t * cage.uvs[2];
  EXPECT_LT(glm::length(point.uv - expected), 1e-15);
  const double h = 1e-6;
  const Vec2 ds = (surface.evaluate(0, s + h, t).uv - surface.evaluate(0, s - h, t).uv) / (2 * h);
  const Vec2 dt = (surface.evaluate(0, s, t + h).uv - surface.evaluate(0, s, t - h).uv) / (2 * h);
  EXPECT_LT(glm::length(point.uvDs - ds), 1e-9);
  EXPECT_LT(glm::length(point.uvDt - dt), 1e-9);
}

TEST(LimitSurface, UvSeamKeepsEachFacesOwnCoordinates) {
  const LimitSurface surface(cubeCage());
  for (int face = 0; face < 6; ++face) {
    EXPECT_EQ(surface.evaluate(face, 1, 0).uv, Vec2(1, 0));
    EXPECT_EQ(surface.evaluate(face, 0, 1).uv, Vec2(0, 1));
  }
}

TEST(LimitSurface, ThreadsSeeTheSameBits) {
  const LimitSurface surface(branchedCage());
  const LimitSurface again(branchedCage());
  constexpr std::size_t count = 20000;
  const auto evaluate = [&](const LimitSurface& which, std::size_t i) {
    const double x = static_cast<double>(i) / count;
    return which.evaluate(static_cast<int>(i) % which.faceCount(), x, std::fmod(7 * x, 1.0));
  };
  std::vector<LimitPoint> points(count);
  parallelFor(0, count, [&](std::size_t i) { points[i] = evaluate(surface, i); });
  for (std::size_t i = 0; i < count; ++i) {
    const LimitPoint point = evaluate(again, i);
    ASSERT_EQ(points[i].position, point.position);
    ASSERT_EQ(points[i].dst, point.dst);
  }
}

TEST(LimitSurface, UnusedVerticesDoNoHarm) {
  Cage cage = cubeCage();
  cage.positions.emplace_back(9, 9, 9);
  expectNear(LimitSurface(cage).evaluate(0, 1, 1).position, Vec3(0.5), 1e-12);
}

TEST(LimitSurface, APillowOfTwoFacesIsFinite) {
  Cage cage = openGrid(1, 1);
  cage.faceVertices = {0, 1, 3, 2, 0, 2, 3, 1};
  cage.faceUvs = cage.faceVertices;
  const LimitSurface surface(cage);
  expectFinite(surface.evaluate(0, 0, 0));
  expectFinite(surface.evaluate(1, 0.4, 0.5));
}

TEST(LimitSurface, HighValenceIsFinite) {
  const LimitSurface surface(polesCage(64));
  for (const double s : {0.0, 1e-3, 0.5, 1.0}) {
    expectFinite(surface.evaluate(0, s, s));
    expectFinite(surface.evaluate(1, s, 0));
  }
}

TEST(OutwardNormal, IsZeroWhereDegenerate) {
  LimitPoint point{};
  EXPECT_EQ(outwardNormal(point), Vec3(0));
  point.ds = {1, 2, 3};
  point.dt = {2, 4, 6};
  EXPECT_EQ(outwardNormal(point), Vec3(0));
  point.dt = {0, 1, 0};
  EXPECT_NEAR(glm::length(outwardNormal(point)), 1, 1e-15);
}

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
