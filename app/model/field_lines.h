#pragma once

#include <cstdint>
#include <vector>

#include "image/images.h"
#include "relief/relief.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"

namespace gnomon::app {

/// A straight piece in the world.
struct LineSegment {
  Vec3 begin, end;
};

/// The principal directions of the base surface, drawn as short lines through points of it.
struct PrincipalLines {
  std::vector<LineSegment> larger;   ///< along v1, of the larger curvature κ₁
  std::vector<LineSegment> smaller;  ///< along v2
};

struct LineSettings {
  int perFaceSide = 2;       ///< lines through perFaceSide² points of every face, ≥ 1
  double lengthShare = 0.6;  ///< of the distance between neighbouring points
  double liftShare = 0.02;   ///< height over the surface, as a share of that distance
};

/// Lines at the middles of a regular grid of parameters. None at an umbilic, where every direction
/// is principal: κ₁ - κ₂ within 0.5 % of the larger |κ| (built-in shapes err by 0.1 %), or both so
/// small that the normal turns by less than 1e-6 over a face; and none where the surface is
/// degenerate.
/// @param settings  perFaceSide² × faces lines at most 2²⁴
/// @throws InputError if there were more
PrincipalLines principalLines(const surface::LimitSurface& surface,
                              const LineSettings& settings = {});

/// κ of the limit surface in the light's direction at every sample of a view, 1 / world, convex
/// positive; NaN-free: `defined` says where it has a meaning (a sample with a normal, and a light
/// that is not along it).
struct CurvatureField {
  std::vector<double> values;         ///< one a sample; 0 where undefined
  std::vector<std::uint8_t> defined;  ///< 1 where defined
  double largest = 0;                 ///< the largest |κ|: what the colours' ends stand for
};

/// On all threads; the same bits whatever their number.
CurvatureField curvatureAlong(const surface::LimitSurface& surface,
                              const surface::SampleGrid& samples, const Vec3& light);

/// The colours of curvature: purple where the surface bends toward the light's side (concave), near
/// white where it is flat, green where it bends away (convex). The pair stays apart for the common
/// colour vision deficiencies, is even in lightness, and is neither of the colours of errors.
struct CurvatureColours {
  static constexpr image::Rgb concave{118, 42, 131};
  static constexpr image::Rgb flat{247, 247, 247};
  static constexpr image::Rgb convex{27, 120, 55};
};

/// Linear from `flat` to the end of the value's sign, which ±largest reaches; `flat` where largest
/// is 0.
image::Rgb curvatureColour(double value, double largest);

}  // namespace gnomon::app
