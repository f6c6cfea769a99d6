#include "surface/sample_grid.h"

#include <cstddef>

#include "common/parallel.h"

namespace gnomon {

SampleGrid rowsOf(const SampleGrid& grid, int first, int count) {
  const auto row = [&](int i) {
    return grid.samples.begin() + static_cast<std::ptrdiff_t>(i) * grid.width;
  };
  return {grid.width, count, {row(first), row(first + count)}};
}

std::vector<double> sampleAreas(const LimitSurface& surface, const SampleGrid& grid,
                                int samplesPerFace) {
  std::vector<double> areas(grid.samples.size(), 0.0);
  parallelFor(
      0, areas.size(),
      [&](std::size_t i) {
        const SurfaceSample& sample = grid.samples[i];
        if (sample.face < 0) return;
        const TangentPoint point = surface.tangentPoint(sample.face, sample.s, sample.t);
        areas[i] = glm::length(glm::cross(point.ds, point.dt)) / samplesPerFace;
      },
      1024);
  return areas;
}

}  // namespace gnomon
