#pragma once

#include <vector>

#include "surface/limit_surface.h"

namespace gnomon {

/// A point of the undisplaced limit surface: the place where the one question is asked.
struct SurfaceSample {
  int face = -1;  ///< limit face, -1 where a pixel shows no surface
  float s = 0;    ///< 0 to 1
  float t = 0;
};

/// The samples of a view, row by row, row 0 at the top of the picture.
struct SampleGrid {
  int width = 0;
  int height = 0;
  std::vector<SurfaceSample> samples;
};

/// The world area that each sample of a regular parameter grid stands for, |P_s × P_t| / side²,
/// where `side` × `side` samples share a face; 0 where there is no sample. For a sphere they sum to
/// its area as the grid grows finer. It is taken at the grid's own points, of which samples may be
/// off by the rounding of a rasteriser, so that every mesh of a surface has the same. It is rounded
/// to 16 significant bits, by 1 part in 130,000 at most: a float holds it exactly, and a picture of
/// it packs well.
std::vector<double> sampleAreas(const LimitSurface& surface, const SampleGrid& grid, int side);

}  // namespace gnomon
