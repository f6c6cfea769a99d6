#include "study/spec/sections/surface_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "study/spec/sections/study_files.h"
#include "surface/cage/shapes.h"
#include "surface/mesh_file.h"

namespace gnomon::study {
namespace {

/// Angle that an arc of `length` spans at `curvature`; a full turn where it comes within rounding.
double arcAngle(double length, double curvature) {
  const double angle = length * curvature;
  return std::abs(angle - 2 * pi) < 1e-6 ? 2 * pi : angle;
}

surface::Cage cageOf(const PlaneShape& plane) {
  return surface::makePlane(plane.size.x, plane.size.y, plane.quads.x, plane.quads.y);
}

surface::Cage cageOf(const CylinderShape& cylinder) {
  return surface::makeCylinder(1 / cylinder.curvature,
                               arcAngle(cylinder.size.x, cylinder.curvature), cylinder.size.y,
                               cylinder.quads.x, cylinder.quads.y);
}

surface::Cage cageOf(const SphereShape& sphere) {
  if (sphere.curvature == 0) {
    throw InputError("sphere: curvature is 0, a number above or below 0 expected");
  }
  const double bend = std::abs(sphere.curvature);
  return surface::makeSphere(1 / sphere.curvature, arcAngle(sphere.size.x, bend),
                             sphere.size.y * bend, sphere.quads.x, sphere.quads.y);
}

surface::Cage cageOf(const TorusShape& torus) {
  return surface::makeTorus(torus.major, torus.minor, torus.quads.x, torus.quads.y);
}

surface::Cage cageOf(const BezierShape& bezier) {
  std::array<Vec3, 16> points{};
  if (bezier.points.size() != points.size()) {
    throw InputError(
        fmt::format("bezier: {} points found, 16 expected, row by row", bezier.points.size()));
  }
  std::copy(bezier.points.begin(), bezier.points.end(), points.begin());
  return surface::makeBezier(points, bezier.quads.x, bezier.quads.y);
}

surface::Cage cageOf(const BSplineShape& spline) {
  const int points = static_cast<int>(spline.points.size());
  const int rows = points / spline.columns;
  if (rows < 4 || rows * spline.columns != points) {
    throw InputError(fmt::format("b-spline: {} points found, at least 4 rows of {} expected",
                                 points, spline.columns));
  }
  return surface::makeBSpline(spline.points, spline.columns, rows);
}

}  // namespace

SurfaceSection readSurfaceSection(const TomlReader& section) {
  SurfaceMesh mesh;
  KeyNames names = namesOfAllKinds<Shape>("shape", keysOf);
  names.merge(namesOf(keysOf(mesh)));
  section.allow(names);
  section.requireOneOf("shape", "mesh");
  if (!section.has("mesh")) return readKind<Shape>(section, "shape", shapeNames, keysOf);
  mesh.isSchemeNamed = section.has("scheme");
  StudyKeys keys = keysOf(mesh);
  if (!mesh.isSchemeNamed)
    std::erase_if(keys, [](const auto& key) { return key.name == "scheme"; });
  readKeys(section, keys);
  return mesh;
}

toml::table tableOf(SurfaceSection surface) {
  toml::table table = tableOf(keysOf(surface));
  if (const auto* shape = std::get_if<Shape>(&surface)) {
    table.insert("shape", shapeNames.at(shape->index()));
  }
  return table;
}

surface::Cage cageOf(const SurfaceSection& surface, const TomlReader& section,
                     const std::filesystem::path& folder, bool inSuite) {
  return std::visit(
      Overloaded{[&](const Shape& shape) {
                   return section.blame("shape", [&] {
                     return std::visit([](const auto& one) { return cageOf(one); }, shape);
                   });
                 },
                 [&](const SurfaceMesh& mesh) {
                   const auto file = namedFile(section, "mesh", folder);
                   if (!mesh.isSchemeNamed && !inSuite) {
                     section.fail("scheme",
                                  "missing, \"catmull-clark\", \"loop\" or \"none\" expected; " +
                                      surface::schemeChoice(file));
                   }
                   return surface::readMeshFile(file, mesh.scheme);
                 }},
      surface);
}

}  // namespace gnomon::study
