#pragma once

#include <vector>

#include "surface/limit_surface.h"

namespace gnomon::surface {

/// The samples of a view, row by row, row 0 at the top of the picture.
struct SampleGrid {
  int width = 0;
  int height = 0;
  std::vector<SurfaceSample> samples;
};

/// The world area that each sample of a regular parameter grid stands for, |P_s × P_t| / side²,
/// where `side` × `side` samples share a face; 0 where there is no sample. For a sphere they sum to
/// its area as the grid grows finer. It is taken at the exact grid points, from which rasterised
/// samples differ by rounding, so that all meshes of a surface get the same areas. It is rounded to
/// 16 significant bits, by 1 part in 130,000 at most: a float holds it exactly, and a picture of it
/// compresses well.
std::vector<double> sampleAreas(const LimitSurface& surface, const SampleGrid& grid, int side);

}  // namespace gnomon::surface
