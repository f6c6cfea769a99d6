#pragma once

#include <vector>

#include "horizon/horizon_bake.h"
#include "relief/height_field.h"

namespace gnomon::horizon {

/// Horizon *angles* off the surface's normal, as Sloan & Cohen 2000 (§2) keep them: a light is seen
/// where its own angle off the normal is smaller. Per texel centre, one layer an azimuth.
struct AngleTable : TableShape {
  /// The largest angle that is kept, radians, up to π: π/2 in their paper (§3).
  double limit = 0;
  std::vector<float> angles;  ///< radians, 0 to `limit`
  /// Texel coordinates of the table's entry (0, 0). A table over the whole surface, whose texels
  /// are all unique, begins where the surface's texture coordinates begin.
  int originX = 0;
  int originY = 0;
};

/// The angles of a flat relief's horizons: π/2 - atan k δ, at most `limit`.
/// @param texelsPerHeight  k > 0, of the frame in which they are taken: see texel_scale.h
AngleTable horizonAngles(const HorizonTables& tables, double limit, double texelsPerHeight);

/// One elliptical cone of light a texel (Kautz, Heidrich & Daubert 2000; Heidrich, Daubert, Kautz &
/// Seidel 2000): the unit directions from which the texel is lit, projected along the normal onto
/// the tangent plane, fill a part of the unit disc; an ellipse approximates it. It is kept as
/// centre c and the symmetric matrix A that takes the unit disc to it: l is lit where
/// |A⁻¹ (l - c)| ≤ 1. Unlike the angle of an axis, A can be interpolated between texels.
///
/// The ellipse is the one with the area's own centroid and second moments: A = 2 Σ^½, Σ the
/// covariance of the lit part.
struct EllipseTable : TableShape {
  /// The layers: c_x, c_y, A_xx, A_xy, A_yy.
  static constexpr int numbers = 5;
  std::vector<float> values;  ///< each -1 to 1
};

/// Fits the ellipses to a flat relief's horizons: toward azimuth φ_m the lit part reaches from the
/// centre to the cosine of the horizon's elevation, 1 / √(1 + max(k δ, 0)²). A texel that no light
/// reaches has A = 0.
/// @param texelsPerHeight  k > 0, of the frame in which directions are taken: see texel_scale.h
EllipseTable fitEllipses(const HorizonTables& tables, double texelsPerHeight);

}  // namespace gnomon::horizon
