#pragma once

#include <vector>

#include "common/vec.h"
#include "horizon/reference/ray_crossings.h"
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

}  // namespace gnomon::horizon
