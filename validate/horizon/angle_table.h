#pragma once

#include <vector>

#include "common/vec.h"
#include "horizon/horizon_bake.h"
#include "relief/height_field.h"
#include "relief/relief.h"
#include "surface/limit_surface.h"

namespace gnomon::horizon {

/// The size of a surface's texels in the world.
struct TexelScale {
  /// T, a texel's width on average, world: T² = area of the surface / area of its texture in
  /// texels, over the faces that have a texel frame. 0 if none has.
  double width = 0;
  double farthest = 0;  ///< greatest coordinate of the surface by magnitude, world
};

/// By the midpoint rule, with some 16,384 points on all faces together and at least one on each.
/// @param texelsPerUv  repeats × map size: texels that one unit of u and of v spans
/// @throws InputError where floats, in which rays and shaders compute with world units, cannot hold
///   the surface: a texel narrower than 1e-7 or wider than 1e7, whose width's fourth power they
///   have no digits for, or points so far from the origin that they are over 1/64 texel apart
TexelScale texelScale(const surface::LimitSurface& surface, Vec2 texelsPerUv);

/// The frame in which angles of the flat relief are taken: the texture's own plane, in texels, over
/// which a height unit is k texels high. A table of slopes needs no such choice, since a slope is
/// scaled where it is read; an angle cannot be, and a table that is laid over the whole surface has
/// one frame for all of it. So a light is brought into this frame and compared there (Sloan &
/// Cohen 2000, §2; Kautz, Heidrich & Daubert 2000).
/// @return k: 1 where heights are texels, and where no texel has a width. Where heights are world
///   units it is 1 / T, so that the frame is the world's own wherever texels are squares of that
///   width.
double texelsPerHeight(relief::HeightSpace space, const TexelScale& scale);

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
/// @param texelsPerHeight  k > 0, of the frame in which they are taken: see angle_table.h
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
/// @param texelsPerHeight  k > 0, of the frame in which directions are taken: see angle_table.h
EllipseTable fitEllipses(const HorizonTables& tables, double texelsPerHeight);

}  // namespace gnomon::horizon
