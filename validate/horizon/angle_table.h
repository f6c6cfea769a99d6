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

}  // namespace gnomon::horizon
