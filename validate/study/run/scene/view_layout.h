#pragma once

#include "common/vec.h"
#include "compare/sample_layout.h"
#include "render/view.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"

namespace gnomon {

/// How a view's samples lie beside each other, for boundary metrics.
///
/// In a camera the unit is the pixel, and the surface breaks between two neighbours that lie
/// farther apart in the world than the `sampleSpacing` of one of them: at the contour of a fold, or
/// of a bump of a displaced mesh.
///
/// In an atlas the unit is the texel: a step to the next column is |∂(x, y)/∂s| over a face's
/// samples a side, one to the next row |∂(x, y)/∂t|, each the mean of what it is at the middles of
/// all faces. All built-in shapes have the same everywhere, so that distances are those on the
/// texture's plane. Nothing breaks within a face, nor between those of a grid chart; the tiles of
/// other surfaces stand alone. The picture's edge is one too where a closed surface goes on.
/// @param texelsPerUv  repeats × map size
SampleLayout makeSampleLayout(const LimitSurface& surface, Vec2 texelsPerUv, const RenderView& view,
                              const SampleGrid& samples);

}  // namespace gnomon
