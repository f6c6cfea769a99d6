#include "surface/cage/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/curvature.h"
#include "surface/limit_surface.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Calls `check(point, u, v)` on a grid of parameters of every face, borders included.
template <typename Check>
void forEachPoint(const LimitSurface& surface, int cuts, const Check& check) {
  const GridChart grid = surface.grid().value();
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (int i = 0; i <= cuts; ++i) {
      for (int j = 0; j <= cuts; ++j) {
        const double s = static_cast<double>(i) / cuts;
        const double t = static_cast<double>(j) / cuts;
        check(surface.evaluate(face, s, t), (face % grid.columns + s) / grid.columns,
              (static_cast<double>(face / grid.columns) + t) / grid.rows);
      }
    }
  }
}

void expectUvIsTheGrid(const LimitSurface& surface) {
  const GridChart grid = surface.grid().value();
  ASSERT_EQ(surface.faceCount(), grid.columns * grid.rows);
  forEachPoint(surface, 2, [&](const LimitPoint& point, double u, double v) {
    EXPECT_NEAR(point.uv.x, u, 1e-14);
    EXPECT_NEAR(point.uv.y, v, 1e-14);
    EXPECT_NEAR(point.uvDs.x, 1.0 / grid.columns, 1e-14);
    EXPECT_NEAR(point.uvDt.y, 1.0 / grid.rows, 1e-14);
    EXPECT_NEAR(point.uvDs.y, 0, 1e-14);
    EXPECT_NEAR(point.uvDt.x, 0, 1e-14);
  });
}

TEST(Plane, IsExact) {
  const LimitSurface surface(makePlane(3, 2, 4, 5));
  expectUvIsTheGrid(surface);
  forEachPoint(surface, 3, [](const LimitPoint& point, double u, double v) {
    expectNear(point.position, {3 * (u - 0.5), 2 * (v - 0.5), 0}, 1e-14);
    expectNear(point.ds, {0.75, 0, 0}, 1e-14);
    expectNear(point.dt, {0, 0.4, 0}, 1e-14);
    expectNear(outwardNormal(point), {0, 0, 1}, 1e-14);
    EXPECT_NEAR(principalCurvatures(point).k1, 0, 1e-12);
    EXPECT_NEAR(principalCurvatures(point).k2, 0, 1e-12);
  });
}

TEST(Plane, OfOneFace) {
  const LimitSurface surface(makePlane(1, 1, 1, 1));
  ASSERT_EQ(surface.faceCount(), 1);
  expectNear(surface.evaluate(0, 0, 0).position, {-0.5, -0.5, 0}, 1e-15);
  expectNear(surface.evaluate(0, 1, 1).position, {0.5, 0.5, 0}, 1e-15);
}

struct SphereErrors {
  double position = 0, curvature = 0;
};

SphereErrors sphereErrors(double radius, double longitude, double latitude, int columns, int rows) {
  const LimitSurface surface(makeSphere(radius, longitude, latitude, columns, rows));
  SphereErrors worst;
  forEachPoint(surface, 8, [&](const LimitPoint& point, double u, double v) {
    const double l = longitude * (u - 0.5);
    const double p = latitude * (v - 0.5);
    const Vec3 exact =
        radius * Vec3(std::sin(l) * std::cos(p), std::sin(p), std::cos(l) * std::cos(p));
    const PrincipalCurvatures principal = principalCurvatures(point);
    worst.position = std::max(worst.position, glm::length(point.position - exact) / radius);
    worst.curvature = std::max({worst.curvature, std::abs(principal.k1 * radius - 1),
                                std::abs(principal.k2 * radius - 1)});
    EXPECT_GT(glm::dot(outwardNormal(point), exact / radius), 1 - 1e-8);
  });
  return worst;
}

TEST(Sphere, PositionAndCurvatureAtSeveralRadiiAndResolutions) {
  for (const double radius : {1e-3, 1.0, 66.7, 1e5}) {
    for (const int columns : {10, 16, 40}) {
      const SphereErrors worst = sphereErrors(radius, 1.0, 0.8, columns, columns - 2);
      EXPECT_LT(worst.position, 1e-5) << radius << ' ' << columns;
      EXPECT_LT(worst.curvature, 1e-3) << radius << ' ' << columns;
      EXPECT_GT(worst.position, 1e-12);  // a spline is no sphere
    }
  }
}

TEST(Sphere, CoarsestFacesThatAreAllowedKeepThePromise) {
  // Found by trial, as a user would find them; up to half a degree from the poles.
  for (const double latitude : {20.0, 90.0, 125.0, 160.0, 174.0, 179.0}) {
    const auto allowed = [&](int columns, int rows) {
      try {
        makeSphere(1, 1, radians(latitude), columns, rows);
        return true;
      } catch (const InputError&) {
        return false;
      }
    };
    int rows = 1;
    while (!allowed(4000, rows)) ++rows;
    int columns = 1;
    while (!allowed(columns, rows)) ++columns;
    const SphereErrors worst = sphereErrors(1, 1, radians(latitude), columns, rows);
    EXPECT_LT(worst.position, 1e-5) << latitude;
    EXPECT_LT(worst.curvature, 1e-3) << latitude << "° " << columns << " × " << rows;
    if (latitude < 150) {
      EXPECT_GT(worst.curvature, 0.8e-3);  // nor is more refused than need be
    }
  }
}

TEST(Sphere, ErrsAsDocumented) {
  // Position by Δ⁴/384 an axis, curvature by Δ²/12: fourth and second order.
  const auto at = [](int faces) { return sphereErrors(1, 0.8, 0.8, faces, faces); };
  const SphereErrors coarse = at(8);
  const SphereErrors fine = at(16);
  EXPECT_NEAR(std::log2(coarse.position / fine.position), 4, 0.05);
  EXPECT_NEAR(std::log2(coarse.curvature / fine.curvature), 2, 0.05);
  const double step = 0.05;
  EXPECT_NEAR(fine.position / (std::pow(step, 4) / 384), 2, 0.1);  // two axes add up
  EXPECT_NEAR(fine.curvature / (step * step / 12), 1, 0.02);
}

TEST(Sphere, TextureCoordinates) {
  expectUvIsTheGrid(LimitSurface(makeSphere(1, 1, 0.5, 12, 6)));
}

TEST(Sphere, AFullTurnCloses) {
  const LimitSurface surface(makeSphere(2, radians(360), 2, 60, 20));
  EXPECT_EQ(surface.faceCount(), 1200);
  expectUvIsTheGrid(surface);
  // First and last column share the cage's vertices, so nothing can open between them.
  EXPECT_EQ(surface.corners(0)[0], surface.corners(59)[1]);
  EXPECT_EQ(surface.corners(0)[3], surface.corners(59)[2]);
  expectNear(surface.evaluate(0, 0, 0.5).position, surface.evaluate(59, 1, 0.5).position, 1e-14);
  const SphereErrors worst = sphereErrors(2, 2 * pi, 2, 60, 20);
  EXPECT_LT(worst.position, 1e-5);
  EXPECT_LT(worst.curvature, 1e-3);
}

TEST(Cylinder, IsWhatItSays) {
  for (const double span : {1.0, radians(360)}) {
    const double radius = 3, height = 4;
    const int columns = span > 6 ? 60 : 16;
    const LimitSurface surface(makeCylinder(radius, span, height, columns, 3));
    expectUvIsTheGrid(surface);
    forEachPoint(surface, 4, [&](const LimitPoint& point, double u, double v) {
      const double l = span * (u - 0.5);
      const Vec3 outward(std::sin(l), 0, std::cos(l));
      expectNear(point.position, radius * outward + Vec3(0, height * (v - 0.5), 0), 1e-5 * radius);
      const PrincipalCurvatures principal = principalCurvatures(point);
      EXPECT_NEAR(principal.k1 * radius, 1, 1e-3);
      EXPECT_NEAR(principal.k2 * radius, 0, 1e-10);
      EXPECT_NEAR(std::abs(principal.v2.y), 1, 1e-10);
      EXPECT_GT(glm::dot(outwardNormal(point), outward), 1 - 1e-8);
    });
  }
}

TEST(Cylinder, AFullTurnCloses) {
  const LimitSurface surface(makeCylinder(1, 2 * pi, 1, 60, 2));
  EXPECT_EQ(surface.corners(0)[0], surface.corners(59)[1]);
  EXPECT_EQ(surface.evaluate(0, 0, 0).uv.x, 0);
  EXPECT_EQ(surface.evaluate(59, 1, 0).uv.x, 1);
}

TEST(Torus, IsWhatItSays) {
  const double major = 5, minor = 1.5;
  const LimitSurface surface(makeTorus(major, minor, 64, 60));
  expectUvIsTheGrid(surface);
  EXPECT_EQ(surface.vertexCount(), 64 * 60);
  forEachPoint(surface, 3, [&](const LimitPoint& point, double u, double v) {
    const double l = 2 * pi * (u - 0.5);
    const double turn = 2 * pi * (v - 0.5);
    const Vec3 outward(std::cos(turn) * std::sin(l), std::sin(turn), std::cos(turn) * std::cos(l));
    const Vec3 exact = major * Vec3(std::sin(l), 0, std::cos(l)) + minor * outward;
    expectNear(point.position, exact, 1e-5 * (major + minor));
    const PrincipalCurvatures principal = principalCurvatures(point);
    EXPECT_NEAR(principal.k1 * minor, 1, 1e-3);
    EXPECT_NEAR(principal.k2 * minor, minor * std::cos(turn) / (major + minor * std::cos(turn)),
                1e-3);
    EXPECT_GT(glm::dot(outwardNormal(point), outward), 1 - 1e-7);
  });
}

TEST(Torus, ThickTubesKeepThePromise) {
  // Curvature errs by less than 0.1 % of the larger one, however narrow the hole.
  for (const double major : {1.02, 1.2, 2.0}) {
    int rows = 1, columns = 1;
    const auto allowed = [&] {
      try {
        makeTorus(major, 1, columns, rows);
        return true;
      } catch (const InputError& error) {
        const bool byRows = std::string(error.what()).find("rows is") != std::string::npos;
        ++(byRows ? rows : columns);
        return false;
      }
    };
    while (!allowed()) {
    }
    const LimitSurface surface(makeTorus(major, 1, columns, rows));
    double worst = 0;
    forEachPoint(surface, 4, [&](const LimitPoint& point, double, double v) {
      const double turn = 2 * pi * (v - 0.5);
      const double around = std::cos(turn) / (major + std::cos(turn));
      const PrincipalCurvatures principal = principalCurvatures(point);
      const double scale = std::max(1.0, std::abs(around));
      worst = std::max({worst, std::abs(principal.k1 - std::max(1.0, around)) / scale,
                        std::abs(principal.k2 - std::min(1.0, around)) / scale});
    });
    EXPECT_LT(worst, 1e-3) << major << ": " << columns << " × " << rows;
    EXPECT_GT(worst, 0.7e-3) << major;
  }
}

/// de Casteljau on one cubic, and on its difference polygons for derivatives.
template <std::size_t N>
Vec3 deCasteljau(std::array<Vec3, N> points, double x) {
  for (std::size_t level = N - 1; level > 0; --level) {
    for (std::size_t i = 0; i < level; ++i) points[i] = glm::mix(points[i], points[i + 1], x);
  }
  return points[0];
}

template <std::size_t N>
std::array<Vec3, N - 1> hodograph(const std::array<Vec3, N>& points) {
  std::array<Vec3, N - 1> result;
  for (std::size_t i = 0; i + 1 < N; ++i) {
    result[i] = static_cast<double>(N - 1) * (points[i + 1] - points[i]);
  }
  return result;
}

/// The derivative of order (m, n) of a bicubic Bézier patch.
Vec3 bezier(const std::array<Vec3, 16>& points, int m, int n, double u, double v) {
  const auto curve = [](const std::array<Vec3, 4>& p, int order, double x) {
    if (order == 0) return deCasteljau(p, x);
    const auto first = hodograph(p);
    return order == 1 ? deCasteljau(first, x) : deCasteljau(hodograph(first), x);
  };
  std::array<Vec3, 4> column;
  for (std::size_t row = 0; row < 4; ++row) {
    column[row] = curve(
        {points[4 * row], points[4 * row + 1], points[4 * row + 2], points[4 * row + 3]}, m, u);
  }
  return curve(column, n, v);
}

TEST(Bezier, AgreesWithDeCasteljau) {
  Random random(7);
  std::array<Vec3, 16> points;
  for (std::size_t i = 0; i < 16; ++i) {
    points[i] =
        Vec3(static_cast<double>(i % 4), static_cast<double>(i / 4), 0) + random.vector(0.8);
  }
  for (const std::array cuts : {std::array{1, 1}, std::array{3, 2}, std::array{7, 16}}) {
    const int columns = cuts[0];
    const int rows = cuts[1];
    const LimitSurface surface(makeBezier(points, columns, rows));
    expectUvIsTheGrid(surface);
    const double hs = 1.0 / columns;
    const double ht = 1.0 / rows;
    forEachPoint(surface, 4, [&](const LimitPoint& point, double u, double v) {
      expectNear(point.position, bezier(points, 0, 0, u, v), 1e-12, "position");
      expectNear(point.ds / hs, bezier(points, 1, 0, u, v), 1e-12 * columns, "ds");
      expectNear(point.dt / ht, bezier(points, 0, 1, u, v), 1e-12 * rows, "dt");
      expectNear(point.dss / (hs * hs), bezier(points, 2, 0, u, v), 1e-12 * columns * columns,
                 "dss");
      expectNear(point.dst / (hs * ht), bezier(points, 1, 1, u, v), 1e-12 * columns * rows, "dst");
      expectNear(point.dtt / (ht * ht), bezier(points, 0, 2, u, v), 1e-12 * rows * rows, "dtt");
    });
  }
}

/// The four uniform cubic B-spline basis functions and their derivatives.
std::array<double, 4> basis(int order, double x) {
  switch (order) {
    case 0:
      return {std::pow(1 - x, 3) / 6, (3 * x * x * x - 6 * x * x + 4) / 6,
              (-3 * x * x * x + 3 * x * x + 3 * x + 1) / 6, x * x * x / 6};
    case 1:
      return {-(1 - x) * (1 - x) / 2, (3 * x * x - 4 * x) / 2, (-3 * x * x + 2 * x + 1) / 2,
              x * x / 2};
    default:
      return {1 - x, 3 * x - 2, 1 - 3 * x, x};
  }
}

TEST(BSpline, AgreesWithItsBasis) {
  constexpr int pointColumns = 7, pointRows = 5;
  Random random(8);
  std::vector<Vec3> points;
  for (int i = 0; i < pointColumns * pointRows; ++i) points.push_back(random.vector(2));
  const LimitSurface surface(makeBSpline(points, pointColumns, pointRows));
  ASSERT_EQ(surface.faceCount(), 4 * 2);
  expectUvIsTheGrid(surface);
  for (int face = 0; face < 8; ++face) {
    for (int k = 0; k < 20; ++k) {
      const double s = random(0, 1), t = random(0, 1);
      const auto derivative = [&](int m, int n) {
        const auto bs = basis(m, s), bt = basis(n, t);
        Vec3 sum(0);
        for (std::size_t j = 0; j < 4; ++j) {
          for (std::size_t i = 0; i < 4; ++i) {
            const auto row = static_cast<std::size_t>(face / 4) + j;
            const auto column = static_cast<std::size_t>(face % 4) + i;
            sum += bt[j] * bs[i] * points[row * pointColumns + column];
          }
        }
        return sum;
      };
      const LimitPoint point = surface.evaluate(face, s, t);
      expectNear(point.position, derivative(0, 0), 1e-13, "position");
      expectNear(point.ds, derivative(1, 0), 1e-13, "ds");
      expectNear(point.dt, derivative(0, 1), 1e-13, "dt");
      expectNear(point.dss, derivative(2, 0), 1e-13, "dss");
      expectNear(point.dst, derivative(1, 1), 1e-13, "dst");
      expectNear(point.dtt, derivative(0, 2), 1e-13, "dtt");
    }
  }
}

TEST(ShapeErrors, NameTheParameter) {
  expectInputError([] { makePlane(0, 1, 1, 1); }, {"plane", "width is 0"});
  expectInputError([] { makePlane(1, nan, 1, 1); }, {"height is nan"});
  expectInputError([] { makePlane(1, 1, 0, 1); }, {"columns is 0", "1 to 4096"});
  expectInputError([] { makePlane(1, 1, 1, 4097); }, {"rows is 4097"});
  expectInputError([] { makeCylinder(-1, 1, 1, 20, 1); }, {"cylinder", "radius is -1"});
  expectInputError([] { makeCylinder(1, 6.5, 1, 80, 1); }, {"longitude span", "360"});
  expectInputError([] { makeCylinder(1, 0, 1, 80, 1); }, {"longitude span is 0°"});
  expectInputError([] { makeSphere(1, nan, 1, 80, 80); }, {"longitude span is nan"});
  expectInputError([] { makeSphere(1, 1, pi, 80, 80); }, {"latitude span is 180°"});
  expectInputError([] { makeSphere(std::numeric_limits<double>::infinity(), 1, 1, 80, 80); },
                   {"radius is inf"});
  expectInputError([] { makeTorus(1, 1, 80, 80); }, {"torus", "minor is 1", "major"});
  expectInputError([] { makeTorus(2, 1, 80, -4); }, {"rows is -4"});
  expectInputError([] { makeBSpline({}, 3, 4); }, {"bspline", "point columns is 3"});
  expectInputError([] { makeBSpline(std::vector<Vec3>(15), 4, 4); }, {"15 points", "16"});
  expectInputError([] { makeBSpline(std::vector<Vec3>(16, Vec3(0, nan, 0)), 4, 4); },
                   {"point 0", "coordinate 2", "nan"});
  expectInputError(
      [] {
        std::array<Vec3, 16> points{};
        points[5].z = nan;
        makeBezier(points, 1, 1);
      },
      {"bezier", "point 5"});
  expectInputError([] { makeBezier({}, 1, 5000); }, {"rows is 5000"});
}

TEST(ShapeErrors, TooCoarseAnArcSaysHowManyFacesItNeeds) {
  // The numbers named are the least that pass.
  expectInputError([] { makeSphere(1, 2 * pi, 1, 57, 20); }, {"columns is 57", "at least 58"});
  EXPECT_NO_THROW(makeSphere(1, 2 * pi, 1, 58, 20));
  expectInputError([] { makeSphere(1, 1, 1, 20, 9); }, {"rows is 9", "at least 10"});
  EXPECT_NO_THROW(makeSphere(1, 1, 1, 20, 10));
  expectInputError([] { makeSphere(1, 2 * pi, 1, 1, 20); }, {"at least 58"});
  expectInputError([] { makeSphere(1, 2 * pi, 1, 2, 20); }, {"at least 58"});
  expectInputError([] { makeTorus(3, 1, 58, 57); }, {"torus", "rows is 57", "at least 58"});
  expectInputError([] { makeCylinder(1, pi, 1, 28, 1); }, {"columns is 28", "at least 29"});
  EXPECT_NO_THROW(makeCylinder(1, pi, 1, 29, 1));
}

}  // namespace
}  // namespace gnomon::surface
