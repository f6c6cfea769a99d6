#pragma once

#include <toml++/toml.h>

#include <optional>

#include "study/spec/suite/suite_file.h"

namespace gnomon::study {

/// A surface that carries a map, in world units.
struct DrawnSurface {
  toml::table section;   ///< [surface]
  double curvature = 0;  ///< largest |κ| × height
  int faces = 1;         ///< with a limit surface
  int subdivisions = 1;  ///< pieces of a face's side that the base mesh has
  Vec3 target{0};        ///< where the camera looks
  double radius = 1;     ///< of a ball about the target that holds the surface, about
  double rim = 0;        ///< degrees: how high its rim stands over the middle of a bowl
};

/// What a surface must carry.
struct SurfaceMap {
  glm::ivec2 texels{0};
  double height = 0;  ///< world units
};

/// Draws a surface of a kind that carries a map; none where that breaks a limit of the suite:
///   a torus whose hole would close;
///   a surface that bends, whose largest |κ| × height is out of bounds: of a free form over 17 × 17
///   points of each of its pieces, and in the relief's own scale there;
///   a free form that folds over. Closed meshes have no bound.
std::optional<DrawnSurface> drawSurface(const SuiteSpec& suite, const SuiteSurface& surface,
                                        const SurfaceMap& map, RandomStream& random);

/// The control points of the same uniform cubic B-spline surface with twice as many pieces a side
/// (Lane & Riesenfeld 1980).
/// @param points  row by row, `columns` a row
std::vector<Vec3> refinedPoints(const std::vector<Vec3>& points, int columns);

}  // namespace gnomon::study
