#include "study/spec/surface_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "study/spec/study_paths.h"
#include "surface/mesh_file.h"
#include "surface/shapes.h"

namespace gnomon {
namespace {

constexpr int mostFacesASide = 4096;

struct Quads {
  int columns;
  int rows;
};

Quads readQuads(const TomlReader& section) {
  const Vec2 quads = section.vec2("quads", Range{1, mostFacesASide});
  const Quads result{static_cast<int>(quads.x), static_cast<int>(quads.y)};
  if (result.columns != quads.x || result.rows != quads.y) {
    section.fail("quads",
                 fmt::format("[{}, {}] found, two whole numbers expected", quads.x, quads.y));
  }
  return result;
}

Cage readPlane(const TomlReader& section) {
  const Quads quads = readQuads(section);
  const Vec2 size = section.vec2("size", positive);
  return section.blame("shape",
                       [&] { return makePlane(size.x, size.y, quads.columns, quads.rows); });
}

/// Angle that an arc of `length` spans at `curvature`; a full turn where it comes within rounding.
double arcAngle(double length, double curvature) {
  const double angle = length * curvature;
  return std::abs(angle - 2 * pi) < 1e-6 ? 2 * pi : angle;
}

Cage readCylinder(const TomlReader& section) {
  const Quads quads = readQuads(section);
  const double curvature = section.number("curvature", positive);
  const Vec2 size = section.vec2("size", positive);
  return section.blame("shape", [&] {
    return makeCylinder(1 / curvature, arcAngle(size.x, curvature), size.y, quads.columns,
                        quads.rows);
  });
}

/// Below 0 it is the inside of the sphere.
Cage readSphere(const TomlReader& section) {
  const Quads quads = readQuads(section);
  const double curvature = section.number("curvature", anyNumber);
  if (curvature == 0) section.fail("curvature", "0 found, a number above or below 0 expected");
  const double bend = std::abs(curvature);
  const Vec2 size = section.vec2("size", positive);
  return section.blame("shape", [&] {
    return makeSphere(1 / curvature, arcAngle(size.x, bend), size.y * bend, quads.columns,
                      quads.rows);
  });
}

Cage readTorus(const TomlReader& section) {
  const Quads quads = readQuads(section);
  const double major = section.number("major", positive);
  const double minor = section.number("minor", Range{0, major, true});
  return section.blame("shape", [&] { return makeTorus(major, minor, quads.columns, quads.rows); });
}

Cage readBezier(const TomlReader& section) {
  const Quads quads = readQuads(section);
  const std::vector<Vec3> list = section.points("points");
  std::array<Vec3, 16> points{};
  if (list.size() != points.size()) {
    section.fail("points", fmt::format("{} points found, 16 expected, row by row", list.size()));
  }
  std::copy(list.begin(), list.end(), points.begin());
  return section.blame("shape", [&] { return makeBezier(points, quads.columns, quads.rows); });
}

Cage readBSpline(const TomlReader& section) {
  const std::vector<Vec3> points = section.points("points");
  const int columns = section.integer("columns", 4, mostFacesASide + 3);
  const int rows = static_cast<int>(points.size()) / columns;
  if (rows < 4 ||
      static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) != points.size()) {
    section.fail("points", fmt::format("{} points found, at least 4 rows of {} expected",
                                       points.size(), columns));
  }
  return section.blame("shape", [&] { return makeBSpline(points, columns, rows); });
}

}  // namespace

Cage readSurfaceSection(const TomlReader& section, const std::filesystem::path& folder) {
  section.allow({"shape", "mesh", "scheme", "quads", "size", "curvature", "major", "minor",
                 "points", "columns"});
  section.requireOneOf("shape", "mesh");
  if (section.has("mesh")) {
    constexpr std::array schemes = {SubdivisionScheme::catmullClark, SubdivisionScheme::loop};
    const auto scheme = schemes.at(section.choice("scheme", {"catmull-clark", "loop"}, 0));
    return readMeshFile(folder / pathOf(section.text("mesh")), scheme);
  }
  constexpr std::array readers = {readPlane, readCylinder, readSphere,
                                  readTorus, readBezier,   readBSpline};
  return readers.at(section.choice(
      "shape", {"plane", "cylinder", "sphere", "torus", "bezier", "b-spline"}))(section);
}

}  // namespace gnomon
