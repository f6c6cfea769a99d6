#include "surface/sample_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/parallel.h"

namespace gnomon::surface {

namespace {

/// The middle of the grid's cell that holds a coordinate.
double gridCoordinate(double coordinate, int side) {
  const int cell = std::clamp(static_cast<int>(coordinate * side), 0, side - 1);
  return (cell + 0.5) / side;
}

/// To 16 significant bits.
double rounded(double value) {
  constexpr int bits = 16;
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, bits)), exponent - bits);
}

}  // namespace

std::vector<double> sampleAreas(const LimitSurface& surface, const SampleGrid& grid, int side) {
  std::vector<double> areas(grid.samples.size(), 0.0);
  parallelFor(
      0, areas.size(),
      [&](std::size_t i) {
        const SurfaceSample& sample = grid.samples[i];
        if (!sample.isOnSurface()) return;
        const TangentPoint point = surface.tangentPoint(sample.face, gridCoordinate(sample.s, side),
                                                        gridCoordinate(sample.t, side));
        areas[i] = rounded(glm::length(glm::cross(point.ds, point.dt)) / (side * side));
      },
      1024);
  return areas;
}

}  // namespace gnomon::surface
