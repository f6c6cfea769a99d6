#include "study/spec/suite/drawn_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "surface/cage/shapes.h"
#include "surface/curvature.h"

namespace gnomon::study {
namespace {

toml::array arrayOf(std::initializer_list<double> numbers) {
  toml::array array;
  for (const double number : numbers) array.push_back(number);
  return array;
}

toml::array pair(glm::ivec2 numbers) {
  return toml::array(numbers.x, numbers.y);
}

/// Thousandths of a world unit.
double rounded(double coordinate) {
  return std::round(coordinate * 1000) / 1000 + 0.0;
}

toml::array pointsOf(const std::vector<Vec3>& points) {
  toml::array array;
  for (const Vec3& p : points) array.push_back(arrayOf({p.x, p.y, p.z}));
  return array;
}

int pieces(double length, double piece) {
  return std::max(1, static_cast<int>(std::ceil(length / piece)));
}

bool isWithin(const SuiteSpec& suite, double curvature) {
  return curvature >= suite.leastCurvature && curvature <= suite.mostCurvature;
}

/// Half a diagonal of a flat patch.
double radiusOf(const SurfaceMap& map) {
  return 0.5 * std::sqrt(static_cast<double>(map.texels.x) * map.texels.x +
                         static_cast<double>(map.texels.y) * map.texels.y);
}

DrawnSurface plane(const SuiteSpec& suite, const SurfaceMap& map) {
  DrawnSurface drawn;
  const glm::ivec2 quads(pieces(map.texels.x, suite.texelsPerFace),
                         pieces(map.texels.y, suite.texelsPerFace));
  drawn.section.insert("shape", "plane");
  drawn.section.insert("size", pair(map.texels));
  drawn.section.insert("quads", pair(quads));
  drawn.faces = quads.x * quads.y;
  drawn.radius = radiusOf(map);
  return drawn;
}

/// A cylinder or a part of a sphere, from outside or from inside.
std::optional<DrawnSurface> arc(const SuiteSpec& suite, const SuiteSurface& surface,
                                const SurfaceMap& map, RandomStream& random) {
  const bool isCylinder = surface.kind == SurfaceKind::cylinder;
  const bool isInside = surface.kind == SurfaceKind::insideSphere;
  const int bent = isCylinder ? map.texels.x : std::max(map.texels.x, map.texels.y);
  const double bend = roundedNumber(surface.turn.draw(random) * pi / 180 / bent);
  if (!isWithin(suite, bend * map.height)) return std::nullopt;
  const Vec2 turn = bend * Vec2(map.texels);
  const auto faces = [&](double texels, double angle) {
    return std::max(pieces(texels, suite.texelsPerFace), pieces(angle, suite.radiansPerFace));
  };
  DrawnSurface drawn = plane(suite, map);
  const glm::ivec2 quads(
      faces(map.texels.x, turn.x),
      isCylinder ? pieces(map.texels.y, suite.texelsPerFace) : faces(map.texels.y, turn.y));
  drawn.section.insert_or_assign("shape", isCylinder ? "cylinder" : "sphere");
  drawn.section.insert_or_assign("quads", pair(quads));
  drawn.section.insert("curvature", isInside ? -bend : bend);
  drawn.curvature = bend * map.height;
  drawn.faces = quads.x * quads.y;
  drawn.target = {0, 0, roundedNumber((isInside ? -1 : 1) / bend)};
  // The rim of a bowl of half angle α is seen α / 2 above its middle's tangent plane.
  if (isInside) drawn.rim = std::max(turn.x, turn.y) / 4 * 180 / pi;
  return drawn;
}

std::optional<DrawnSurface> torus(const SuiteSpec& suite, const SurfaceMap& map) {
  const double major = roundedNumber(map.texels.x / (2 * pi));
  const double minor = roundedNumber(map.texels.y / (2 * pi));
  constexpr double widestTube = 0.7;  // of the ring: a hole is left
  const double curvature = map.height / minor;
  if (minor > widestTube * major || !isWithin(suite, curvature)) return std::nullopt;
  const auto faces = [&](int texels) {
    return std::max(pieces(texels, suite.texelsPerFace), pieces(2 * pi, suite.radiansPerFace));
  };
  DrawnSurface drawn;
  const glm::ivec2 quads(faces(map.texels.x), faces(map.texels.y));
  drawn.section.insert("shape", "torus");
  drawn.section.insert("major", major);
  drawn.section.insert("minor", minor);
  drawn.section.insert("quads", pair(quads));
  drawn.curvature = curvature;
  drawn.faces = quads.x * quads.y;
  drawn.radius = major + minor + map.height;
  return drawn;
}

/// The largest |κ| × height of a patch in the relief's own scale |P_x × P_y|^½; none where the
/// patch folds over.
std::optional<double> largestCurvature(const surface::LimitSurface& surface,
                                       const SurfaceMap& map) {
  constexpr int points = 17;
  const auto grid = *surface.grid();
  const double texelsPerFace = static_cast<double>(map.texels.x) / grid.columns *
                               (static_cast<double>(map.texels.y) / grid.rows);
  double largest = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (int j = 0; j < points; ++j) {
      for (int i = 0; i < points; ++i) {
        const surface::LimitPoint point =
            surface.evaluate(face, i / (points - 1.0), j / (points - 1.0));
        constexpr double steepest = 0.3;
        if (surface::outwardNormal(point).z < steepest) return std::nullopt;
        const double texel = glm::length(glm::cross(point.ds, point.dt)) / texelsPerFace;
        const surface::PrincipalCurvatures bends = surface::principalCurvatures(point);
        const double bend = std::max(std::abs(bends.k1), std::abs(bends.k2));
        largest = std::max(largest, bend * map.height * std::sqrt(texel));
      }
    }
  }
  return largest;
}

/// A grid of control points that strays from the plane, upward and sideways.
/// @param pieces   of the patch between the outermost points of a Bézier patch; of a B-spline,
///   whose points stand a piece apart
/// @param columns  points a row
std::vector<Vec3> strayingPoints(const SuiteSurface& surface, const SurfaceMap& map,
                                 glm::ivec2 columns, Vec2 spacing, RandomStream& random) {
  const double bend = surface.bend.draw(random) * (map.texels.x + map.texels.y) / 2;
  std::vector<Vec3> points;
  for (int j = 0; j < columns.y; ++j) {
    for (int i = 0; i < columns.x; ++i) {
      const double x = (i - (columns.x - 1) / 2.0 + surface.sway.draw(random)) * spacing.x;
      const double y = (j - (columns.y - 1) / 2.0 + surface.sway.draw(random)) * spacing.y;
      const double z = bend * (2 * random.unit() - 1);
      points.emplace_back(rounded(x), rounded(y), rounded(z));
    }
  }
  return points;
}

std::optional<DrawnSurface> bezier(const SuiteSpec& suite, const SuiteSurface& surface,
                                   const SurfaceMap& map, RandomStream& random) {
  const Vec2 spacing = Vec2(map.texels) / 3.0;
  const std::vector<Vec3> points = strayingPoints(surface, map, {4, 4}, spacing, random);
  std::array<Vec3, 16> net{};
  std::copy(points.begin(), points.end(), net.begin());
  const auto curvature =
      largestCurvature(surface::LimitSurface(surface::makeBezier(net, 1, 1)), map);
  if (!curvature || !isWithin(suite, *curvature)) return std::nullopt;
  DrawnSurface drawn = plane(suite, map);
  drawn.section.erase("size");
  drawn.section.insert_or_assign("shape", "bezier");
  drawn.section.insert("points", pointsOf(points));
  drawn.curvature = *curvature;
  return drawn;
}

/// Pieces of a B-spline's side: 4, 5 or 6, doubled until there are enough faces.
struct SplineSide {
  int pieces, doublings;
};

SplineSide splineSide(int texels, double texelsPerFace) {
  const int least = pieces(texels, texelsPerFace);
  SplineSide best{4, 30};
  for (const int count : {4, 5, 6}) {
    int doublings = 0;
    while (count << doublings < least) ++doublings;
    if (count << doublings < static_cast<std::int64_t>(best.pieces) << best.doublings) {
      best = {count, doublings};
    }
  }
  return best;
}

std::vector<Vec3> transposed(const std::vector<Vec3>& points, int columns) {
  std::vector<Vec3> turned;
  const std::size_t rows = points.size() / static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < static_cast<std::size_t>(columns); ++i) {
    for (std::size_t j = 0; j < rows; ++j) {
      turned.push_back(points[j * static_cast<std::size_t>(columns) + i]);
    }
  }
  return turned;
}

/// Twice as many pieces along the rows alone.
std::vector<Vec3> refinedRows(const std::vector<Vec3>& points, int columns) {
  std::vector<Vec3> refined;
  const auto width = static_cast<std::size_t>(columns);
  for (std::size_t row = 0; row < points.size(); row += width) {
    for (std::size_t i = 0; i + 1 < width; ++i) {
      const Vec3& here = points[row + i];
      const Vec3& next = points[row + i + 1];
      if (i > 0) refined.push_back((points[row + i - 1] + 6.0 * here + next) / 8.0);
      refined.push_back((here + next) / 2.0);
    }
  }
  return refined;
}

std::optional<DrawnSurface> bSpline(const SuiteSpec& suite, const SuiteSurface& surface,
                                    const SurfaceMap& map, RandomStream& random) {
  const SplineSide across = splineSide(map.texels.x, suite.texelsPerFace);
  const SplineSide up = splineSide(map.texels.y, suite.texelsPerFace);
  const Vec2 spacing = Vec2(map.texels) / Vec2(across.pieces, up.pieces);
  glm::ivec2 columns(across.pieces + 3, up.pieces + 3);
  std::vector<Vec3> points = strayingPoints(surface, map, columns, spacing, random);
  const auto curvature = largestCurvature(
      surface::LimitSurface(surface::makeBSpline(points, columns.x, columns.y)), map);
  if (!curvature || !isWithin(suite, *curvature)) return std::nullopt;
  for (int k = 0; k < across.doublings; ++k) {
    points = refinedRows(points, columns.x);
    columns.x = 2 * columns.x - 3;
  }
  points = transposed(points, columns.x);
  for (int k = 0; k < up.doublings; ++k) {
    points = refinedRows(points, columns.y);
    columns.y = 2 * columns.y - 3;
  }
  points = transposed(points, columns.y);
  for (Vec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) point[axis] = rounded(point[axis]);
  }
  DrawnSurface drawn;
  drawn.section.insert("shape", "b-spline");
  drawn.section.insert("columns", columns.x);
  drawn.section.insert("points", pointsOf(points));
  drawn.curvature = *curvature;
  drawn.faces = (columns.x - 3) * (columns.y - 3);
  drawn.radius = radiusOf(map);
  return drawn;
}

DrawnSurface mesh(const SuiteSpec& suite, const SuiteSurface& surface, const SurfaceMap& map) {
  DrawnSurface drawn;
  drawn.section.insert("mesh", surface.file);
  drawn.subdivisions = pieces(surface.face * map.texels.x, suite.texelsPerFace);
  drawn.faces = pieces(1, surface.face * surface.face);
  drawn.target = surface.target;
  drawn.radius = surface.radius;
  return drawn;
}

}  // namespace

std::vector<Vec3> refinedPoints(const std::vector<Vec3>& points, int columns) {
  const std::vector<Vec3> wide = refinedRows(points, columns);
  const int rows = static_cast<int>(points.size()) / columns;
  const std::vector<Vec3> all = refinedRows(transposed(wide, 2 * columns - 3), rows);
  return transposed(all, 2 * rows - 3);
}

std::optional<DrawnSurface> drawSurface(const SuiteSpec& suite, const SuiteSurface& surface,
                                        const SurfaceMap& map, RandomStream& random) {
  switch (surface.kind) {
    case SurfaceKind::plane:
      return plane(suite, map);
    case SurfaceKind::cylinder:
    case SurfaceKind::sphere:
    case SurfaceKind::insideSphere:
      return arc(suite, surface, map, random);
    case SurfaceKind::torus:
      return torus(suite, map);
    case SurfaceKind::bezier:
      return bezier(suite, surface, map, random);
    case SurfaceKind::bSpline:
      return bSpline(suite, surface, map, random);
    case SurfaceKind::mesh:
      return mesh(suite, surface, map);
  }
  throw InternalError("a kind of surface without its draw");
}

}  // namespace gnomon::study
