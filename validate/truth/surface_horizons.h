#pragma once

#include "common/progress.h"
#include "horizon/angle_table.h"
#include "relief/relief.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "truth/micro_scene.h"

namespace gnomon::truth {

/// Horizon angles of the real displaced geometry, one texel a sample (Sloan & Cohen 2000, §3): from
/// every texel's displaced point rays are shot toward each azimuth of the texture plane, starting
/// at `limit` off the undisplaced surface's normal and moving toward the normal until one meets
/// nothing. Where facets of the mesh meet in the point, they start on the one that the azimuth
/// leads onto. The table then includes the shadows of the surface's own curvature.
///
/// The rise is by 4° at a time, then by bisection between the last two rays to a thousandth of a
/// radian; light that slips through a gap narrower than 4° is not seen. A texel without a sample or
/// without a frame gets `limit`.
/// @param texels    the samples at the texel centres of the whole surface; row 0 is the *highest*
/// v,
///   as in views. The table's row 0 is the lowest.
/// @param azimuths  M ≥ 1
/// @param limit     largest angle off the normal, radians, 0 to π
/// @throws MemoryError if the table cannot fit
horizon::AngleTable shootHorizons(const surface::LimitSurface& surface,
                                  const relief::Relief& relief, const MicroMesh& mesh,
                                  const MicroScene& scene, const surface::SampleGrid& texels,
                                  int azimuths, double limit, const Progress& progress = {});

}  // namespace gnomon::truth
