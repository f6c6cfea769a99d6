#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "common/progress.h"
#include "relief/relief.h"
#include "surface/face_grids.h"
#include "surface/limit_surface.h"

namespace gnomon::displaced {

/// Takes the displaced points of some vertices of one row, world, from vertex `first` on.
using PointSink = std::function<void(std::size_t first, std::span<const Vec3> points)>;

/// The displaced limit points D = P + a h n at all vertices of grids, for the micro-mesh that rays
/// are traced on and for the exported mesh. Every vertex is computed by its own face: across a
/// texture seam neighbours differ until one is copied to the other (forEachSharedVertex).
/// @param sink      is called once for each vertex, from several threads at once
/// @param progress  may throw to cancel, see common/progress.h
void displaceGrids(const surface::LimitSurface& surface, const relief::Relief& relief,
                   const surface::FaceGrids& grids, const PointSink& sink,
                   const Progress& progress = {});

}  // namespace gnomon::displaced
