#pragma once

#include <vector>

#include "common/vec.h"
#include "horizon/stored_table.h"
#include "relief/height_field.h"

namespace gnomon::horizon {

/// One point of a profile.
struct ProfilePoint {
  double distance;  ///< r, texels along the ray; below 0 behind its origin
  double height;    ///< h(p + r e), height units
};

/// The relief along a straight line of the texture, cut where it crosses the lattice of texel
/// centres: between two neighbouring points h is one parabola, h = A + B r + C r².
struct HeightProfile {
  Vec2 origin;     ///< p, texels
  Vec2 direction;  ///< e, unit
  /// By distance: -behind (if that is above 0), the crossings, 0, the crossings, radius.
  std::vector<ProfilePoint> points;
};

/// @param origin     any finite position, texels
/// @param direction  unit
/// @param radius     D > 0, texels ahead; @param behind  texels backward, at least 0
HeightProfile heightProfile(const relief::HeightField& field, Vec2 origin, Vec2 direction,
                            double radius, double behind = 0);

/// A horizon of the flat relief.
struct FlatHorizon {
  double slope;     ///< δ, height units per texel
  double distance;  ///< d, texels; 0 where the horizon is attached
};

/// δ and d of one position, as `bakeHorizons` finds them for texel centres: the supremum over
/// 0 < r ≤ D of (h(p + r e) - h(p)) / r and the smallest r that attains it, by the same rule for
/// what counts as greater. Agrees with a bake up to its float rounding.
/// @param origin     any finite position, texels
/// @param direction  unit; @param radius  D > 0, texels
FlatHorizon flatHorizon(const relief::HeightField& field, Vec2 origin, Vec2 direction,
                        double radius);

/// What a curvature-aware horizon method knows at one point in one direction. Lengths in the world.
struct HorizonLookups {
  double curvature;  ///< κ of the surface in that direction, 1 / world, convex positive
  double height;     ///< h₀: the relief at the point
  double slope;      ///< tan β: the flat relief's horizon
  double arcLength;  ///< d ≥ 0: arc length to the horizon point; 0 where the horizon is attached
};

/// The corrected horizons below are slopes, tan β′, over the tangent plane at the point; γ = κd. On
/// a flat surface each but `bareHorizon` is tan β itself. In a denominator 1 + κh counts as 1e-3 at
/// least: a bump in a bowl does not reach the circle's centre.

/// (2) of Onoue, Max & Nishita 2004: tan β′ ≈ tan β (1 - κh) - κd / 2.
double smallAngleHorizon(const HorizonLookups& at);

/// The formula without a number before (2), in which angles are not yet small; with R = 1 / κ,
///   tan β′ = (d tan β cos γ - 2 (R + h) sin²(γ/2)) / (2 (R + h) sin(γ/2) cos(γ/2)).
/// As d → 0 it tends to tan β / (1 + κh). Past a quarter turn, |γ| > π/2, it is minus infinity, as
/// is `osculatingHorizon`.
double unreducedHorizon(const HorizonLookups& at);

/// The horizon of the occluder of height h₁ = h₀ + d tan β that stands on the osculating circle:
///   tan β′ = (cos γ - (1 + κh₀) / (1 + κh₁)) / sin γ.
/// As d → 0 it tends to tan β / (1 + κh₀). Minus infinity past a quarter turn, |γ| > π/2: there the
/// circle says nothing of the surface.
double osculatingHorizon(const HorizonLookups& at);

/// (3) of Onoue, Max & Nishita 2004: the horizon of the bare surface from a height over it,
///   tan β′ = -√(1 - c²) / c, c = 1 / (κh + 1), that is -√(κh (κh + 2)).
/// Below the bare surface h counts as 0; minus infinity where κ ≤ 0, since only a convex surface
/// has such a horizon.
double bareHorizon(double curvature, double height);

/// Unit vector of azimuth φ_m = 2πm/M, exact where it lies on an axis, with equal components on a
/// diagonal, and with the same digits in every quadrant.
Vec2 azimuthDirection(int azimuth, int azimuths);

/// A node of the lattice of texel centres, relative to the one that the ray starts from (or to the
/// lower left one of the cell that it starts in).
struct Node {
  int x, y;
};

/// The part of a ray inside one cell of the lattice of texel centres (a unit square between four
/// of them) and the point where it leaves the cell, on the lattice line between two nodes.
struct Crossing {
  double enter;   ///< r where the ray enters the cell, texels
  double leave;   ///< r where it leaves it
  Node cell;      ///< the cell's lower left node
  Node from, to;  ///< the height at `leave` is h(from) + share · (h(to) - h(from))
  double share;   ///< 0 to 1; 0 on a node
};

/// A ray cut at every lattice line. From one texel centre the cuts are the same as from any other,
/// since all of them are nodes.
struct RayCrossings {
  Vec2 direction;                   ///< unit
  std::vector<Crossing> crossings;  ///< by distance; lines met at one node count once
  double radius;                    ///< D, where the ray ends
  Node lastCell;                    ///< the cell in which it ends
  /// Where the ray enters the last cell; equal to `radius` if it ends on a lattice line.
  double lastEnter;
};

/// @param direction  unit; @param radius  D > 0, texels
/// @param offset     of the ray's origin from its node, texels, 0 ≤ offset < 1: 0 for a texel
/// centre
RayCrossings cutRay(Vec2 direction, double radius, Vec2 offset = Vec2(0));

/// A table's value as shaders filter it (`filter = "exact"`): linear between texel centres in x and
/// y and between azimuths, in double.
/// @param texel    any finite position, texels
/// @param azimuth  radians, any finite angle
double filteredValue(const StoredTable& table, const TableShape& shape, Vec2 texel, double azimuth);

}  // namespace gnomon::horizon
