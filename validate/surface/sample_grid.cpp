#include "surface/sample_grid.h"

#include "common/parallel.h"

namespace gnomon {

std::vector<double> sampleAreas(const LimitSurface& surface, const SampleGrid& grid,
                                int samplesPerFace) {
  std::vector<double> areas(grid.samples.size(), 0.0);
  parallelFor(
      0, areas.size(),
      [&](std::size_t i) {
        const SurfaceSample& sample = grid.samples[i];
        if (sample.face < 0) return;
        const LimitPoint point = surface.evaluate(sample.face, sample.s, sample.t);
        areas[i] = glm::length(glm::cross(point.ds, point.dt)) / samplesPerFace;
      },
      1024);
  return areas;
}

}  // namespace gnomon
