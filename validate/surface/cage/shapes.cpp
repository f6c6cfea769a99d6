#include "surface/cage/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/system/memory.h"

namespace gnomon::surface {
namespace {

constexpr int mostFaces = 4096;
constexpr double mostCurvatureError = 1e-3;
constexpr double largestLength = 1e12;

void requireLength(const char* shape, const char* name, double value) {
  if (!(value > 0) || !(value <= largestLength)) {
    throw InputError(fmt::format("{}: {} is {:g}, expected a length above 0 and at most {:g}",
                                 shape, name, value, largestLength));
  }
}

void requireFaces(const char* shape, const char* name, int value, int least = 1,
                  int most = mostFaces) {
  if (value < least || value > most) {
    throw InputError(
        fmt::format("{}: {} is {}, expected {} to {}", shape, name, value, least, most));
  }
}

void requirePoints(const char* shape, const Vec3* points, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(points[i][axis]) <= largestLength)) {
        throw InputError(fmt::format("{}: point {}: coordinate {} is {:g}, expected -{:g} to {:g}",
                                     shape, i, axis + 1, points[i][axis], largestLength,
                                     largestLength));
      }
    }
  }
}

/// Degrees come in as radians, so a full turn is one up to rounding.
bool isFullTurn(double span) {
  return std::abs(span - 2 * pi) < 1e-9;
}

void requireLongitude(const char* shape, double span) {
  if (!(span > 0) || !(span <= 2 * pi || isFullTurn(span))) {
    throw InputError(
        fmt::format("{}: longitude span is {:.6g}°, expected above 0° and at most "
                    "360°",
                    shape, span * 180 / pi));
  }
}

void requireLatitude(const char* shape, double span) {
  if (!(span > 0) || !(span < pi)) {
    throw InputError(
        fmt::format("{}: latitude span is {:.6g}°, expected above 0° and below 180° "
                    "(a pole has no texture direction)",
                    shape, span * 180 / pi));
  }
}

/// Control points of a circle are its own points times this: the uniform cubic B-spline is
/// (P₋₁ + 4 P₀ + P₁) / 6 at a knot.
double arcScale(double step) {
  return 3 / (2 + std::cos(step));
}

/// Largest angle by which the spline's tangent leaves the circle's: the derivative of
/// s²(1 - s)² Δ³ / 24 at s = ½ - √3/6.
double arcTilt(double step) {
  return std::sqrt(3.0) / 216 * step * step * step;
}

/// One of the two families of circles that a shape of revolution is made of.
struct Arc {
  const char* shape;
  const char* name;  ///< of the count of faces
  double span;
  int faces;
  /// By how much a tilt of the normal changes a curvature, relative to the larger one: the tangent
  /// of the highest latitude on a sphere. It is what makes a pole so expensive.
  double steepness;

  [[nodiscard]] double step() const { return span / faces; }
};

/// Refuses faces that span so much of an arc that a curvature would err by 0.1 % of the larger one:
/// a tenth of that may come of tilt, and what `otherTilt` takes is not left for this arc. Position
/// needs no limit of its own: Δ stays below 0.11, where it errs by 4e-7 R.
void requireFine(const Arc& arc, double otherTilt = 0) {
  constexpr double mostFromTilt = mostCurvatureError / 10;
  const double left = mostCurvatureError - otherTilt * arc.steepness;
  // At a knot, where it is largest, the spline's κR = (4 + 2 cos Δ) / (3 + 3 cos Δ), which exceeds
  // 1 by tan²(Δ/2) / 3.
  const double byCurvature = 2 * std::atan(std::sqrt(3 * left));
  const double byTilt = std::cbrt(mostFromTilt / (arc.steepness * arcTilt(1)));
  const double largestStep = std::min(byCurvature, byTilt);
  if (arc.step() < largestStep) return;
  throw InputError(
      fmt::format("{}: {} is {}, but {:.6g}° need at least {:.0f} for curvature to err "
                  "by less than {} %",
                  arc.shape, arc.name, arc.faces, arc.span * 180 / pi,
                  std::floor(arc.span / largestStep) + 1, 100 * mostCurvatureError));
}

/// One direction of a grid of faces. Knots 0 to `faces` bound them. An open axis has a supporting
/// face and control point more at each end; a closed one wraps.
struct Axis {
  int faces;
  bool closed;

  [[nodiscard]] int cells() const { return closed ? faces : faces + 2; }
  [[nodiscard]] int points() const { return closed ? faces : faces + 3; }
  [[nodiscard]] int firstKnot() const { return closed ? 0 : -1; }
  [[nodiscard]] int wrap(int point) const { return closed ? point % faces : point; }
  /// Where a line of cell corners lies in [0, 1] texture coordinates.
  [[nodiscard]] double uv(int line) const {
    return static_cast<double>(firstKnot() + line) / faces;
  }
};

void appendFaces(Cage& cage, const Axis& columns, const Axis& rows) {
  const int uvColumns = columns.cells() + 1;
  for (int row = 0; row < rows.cells(); ++row) {
    for (int column = 0; column < columns.cells(); ++column) {
      for (const auto [i, j] : {std::array{column, row}, std::array{column + 1, row},
                                std::array{column + 1, row + 1}, std::array{column, row + 1}}) {
        cage.faceVertices.push_back(rows.wrap(j) * columns.points() + columns.wrap(i));
        cage.faceUvs.push_back(j * uvColumns + i);
      }
    }
  }
}

/// @param controlPoint  (column knot, row knot) → control point
template <typename ControlPoint>
Cage makeGrid(const char* shape, const Axis& columns, const Axis& rows,
              const ControlPoint& controlPoint) {
  const auto cells =
      static_cast<std::size_t>(columns.cells()) * static_cast<std::size_t>(rows.cells());
  constexpr double bytesPerCell = sizeof(Vec3) + sizeof(Vec2) + 8 * sizeof(int);
  requireMemory(1.1 * bytesPerCell * static_cast<double>(cells),
                fmt::format("{}: {} columns × {} rows", shape, columns.faces, rows.faces));
  Cage cage;
  cage.border = CageBorder::support;
  cage.grid = GridChart{columns.faces, rows.faces};
  cage.faceVertices.reserve(4 * cells);
  cage.faceUvs.reserve(4 * cells);
  for (int j = 0; j < rows.points(); ++j) {
    for (int i = 0; i < columns.points(); ++i) {
      cage.positions.push_back(controlPoint(columns.firstKnot() + i, rows.firstKnot() + j));
    }
  }
  for (int j = 0; j <= rows.cells(); ++j) {
    for (int i = 0; i <= columns.cells(); ++i) cage.uvs.emplace_back(columns.uv(i), rows.uv(j));
  }
  appendFaces(cage, columns, rows);
  return cage;
}

/// Blossoms of the four cubic Bernstein polynomials at the knots about knot i of n: the weights of
/// the Bézier points in a B-spline control point (Ramshaw 1987).
std::array<double, 4> blossomWeights(int i, int n) {
  const double a = static_cast<double>(i - 1) / n;
  const double b = static_cast<double>(i) / n;
  const double c = static_cast<double>(i + 1) / n;
  return {(1 - a) * (1 - b) * (1 - c),
          a * (1 - b) * (1 - c) + (1 - a) * b * (1 - c) + (1 - a) * (1 - b) * c,
          a * b * (1 - c) + a * (1 - b) * c + (1 - a) * b * c, a * b * c};
}

}  // namespace

Cage makePlane(double width, double height, int columns, int rows) {
  requireLength("plane", "width", width);
  requireLength("plane", "height", height);
  requireFaces("plane", "columns", columns);
  requireFaces("plane", "rows", rows);
  return makeGrid("plane", {columns, false}, {rows, false}, [&](int i, int j) {
    return Vec3(width * (static_cast<double>(i) / columns - 0.5),
                height * (static_cast<double>(j) / rows - 0.5), 0);
  });
}

Cage makeCylinder(double radius, double longitudeSpan, double height, int columns, int rows) {
  requireLength("cylinder", "radius", radius);
  requireLength("cylinder", "height", height);
  requireLongitude("cylinder", longitudeSpan);
  requireFaces("cylinder", "columns", columns);
  requireFaces("cylinder", "rows", rows);
  requireFine({"cylinder", "columns", longitudeSpan, columns, 0});
  const double step = longitudeSpan / columns;
  const double scaled = radius * arcScale(step);
  return makeGrid(
      "cylinder", {columns, isFullTurn(longitudeSpan)}, {rows, false}, [&](int i, int j) {
        const double longitude = step * i - longitudeSpan / 2;
        return Vec3(scaled * std::sin(longitude), height * (static_cast<double>(j) / rows - 0.5),
                    scaled * std::cos(longitude));
      });
}

Cage makeSphere(double radius, double longitudeSpan, double latitudeSpan, int columns, int rows) {
  const double side = radius < 0 ? -1 : 1;
  radius = std::abs(radius);
  requireLength("sphere", "radius", radius);
  requireLongitude("sphere", longitudeSpan);
  requireLatitude("sphere", latitudeSpan);
  requireFaces("sphere", "columns", columns);
  requireFaces("sphere", "rows", rows);
  const double steepness = std::tan(latitudeSpan / 2);
  const Arc meridian = {"sphere", "rows", latitudeSpan, rows, steepness};
  requireFine(meridian);
  requireFine({"sphere", "columns", longitudeSpan, columns, steepness}, arcTilt(meridian.step()));
  const double columnStep = longitudeSpan / columns;
  const double rowStep = latitudeSpan / rows;
  const double along = radius * arcScale(rowStep);
  const double around = along * arcScale(columnStep);
  return makeGrid("sphere", {columns, isFullTurn(longitudeSpan)}, {rows, false}, [&](int i, int j) {
    const double longitude = columnStep * i - longitudeSpan / 2;
    const double latitude = rowStep * j - latitudeSpan / 2;
    return Vec3(around * std::sin(longitude) * std::cos(latitude), along * std::sin(latitude),
                side * around * std::cos(longitude) * std::cos(latitude));
  });
}

Cage makeTorus(double major, double minor, int columns, int rows) {
  requireLength("torus", "major", major);
  requireLength("torus", "minor", minor);
  if (!(minor < major)) {
    throw InputError(
        fmt::format("torus: minor is {:g}, expected less than major, {:g}", minor, major));
  }
  requireFaces("torus", "columns", columns);
  requireFaces("torus", "rows", rows);
  // The largest of minor sin ψ / (major + minor cos ψ) over the tube's angle ψ.
  const double steepness = minor / std::sqrt((major - minor) * (major + minor));
  const Arc tubeArc = {"torus", "rows", 2 * pi, rows, steepness};
  requireFine(tubeArc);
  requireFine({"torus", "columns", 2 * pi, columns, steepness}, arcTilt(tubeArc.step()));
  const double columnStep = 2 * pi / columns;
  const double rowStep = 2 * pi / rows;
  const double tube = minor * arcScale(rowStep);
  const double around = arcScale(columnStep);
  return makeGrid("torus", {columns, true}, {rows, true}, [&](int i, int j) {
    const double longitude = columnStep * i - pi;
    const double psi = rowStep * j - pi;
    const double distance = around * (major + tube * std::cos(psi));
    return Vec3(distance * std::sin(longitude), tube * std::sin(psi),
                distance * std::cos(longitude));
  });
}

Cage makeBezier(const std::array<Vec3, 16>& points, int columns, int rows) {
  requirePoints("bezier", points.data(), points.size());
  requireFaces("bezier", "columns", columns);
  requireFaces("bezier", "rows", rows);
  return makeGrid("bezier", {columns, false}, {rows, false}, [&](int i, int j) {
    const std::array<double, 4> u = blossomWeights(i, columns);
    const std::array<double, 4> v = blossomWeights(j, rows);
    Vec3 point(0);
    for (std::size_t k = 0; k < 16; ++k) point += v[k / 4] * u[k % 4] * points[k];
    return point;
  });
}

Cage makeBSpline(const std::vector<Vec3>& points, int pointColumns, int pointRows) {
  requireFaces("bspline", "point columns", pointColumns, 4, mostFaces + 3);
  requireFaces("bspline", "point rows", pointRows, 4, mostFaces + 3);
  const auto columns = static_cast<std::size_t>(pointColumns);
  const std::size_t count = columns * static_cast<std::size_t>(pointRows);
  if (points.size() != count) {
    throw InputError(fmt::format("bspline: {} points, expected {} columns × {} rows = {}",
                                 points.size(), pointColumns, pointRows, count));
  }
  requirePoints("bspline", points.data(), points.size());
  return makeGrid("bspline", {pointColumns - 3, false}, {pointRows - 3, false}, [&](int i, int j) {
    return points[static_cast<std::size_t>(j + 1) * columns + static_cast<std::size_t>(i + 1)];
  });
}

}  // namespace gnomon::surface
