#include "export/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/parallel.h"
#include "truth/sample_place.h"

namespace gnomon::exporting {
namespace {

/// Over some samples: sums in place of means.
struct Sums {
  std::size_t samples = 0;
  double largest = 0, sum = 0, largestTexels = 0, sumTexels = 0;

  void add(double world, double texels) {
    ++samples;
    largest = std::max(largest, world);
    sum += world;
    largestTexels = std::max(largestTexels, texels);
    sumTexels += texels;
  }
  void add(const Sums& other) {
    samples += other.samples;
    largest = std::max(largest, other.largest);
    sum += other.sum;
    largestTexels = std::max(largestTexels, other.largestTexels);
    sumTexels += other.sumTexels;
  }
};

}  // namespace

MeshDistance meshDistance(study::RunScene& scene, const truth::MicroMesh& truth,
                          const displaced::WeldedMesh& exported, int pieces) {
  Sums all;
  for (const study::ViewCase& view : scene.standardBase().views) {
    const surface::SampleGrid& grid = view.samples;
    const auto width = static_cast<std::size_t>(grid.width);
    std::vector<Sums> rows(static_cast<std::size_t>(grid.height));
    parallelFor(0, rows.size(), [&](std::size_t row) {
      truth::SamplePlacer placer(scene.surface, scene.study.relief.texelsPerUv(), truth);
      for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
        const truth::SamplePlace place = placer.place(grid.samples[i]);
        if (!place.defined) continue;
        const Vec3 other =
            displaced::pointOn(exported, pieces, place.sample.face, place.sample.s, place.sample.t);
        const double world = glm::length(place.facet.point + truth.centre() - other);
        const double texel = std::sqrt(glm::length(glm::cross(place.frame.px, place.frame.py)));
        rows[row].add(world, world / texel);
      }
    });
    for (const Sums& row : rows) all.add(row);  // in one order: the same bits on any machine
  }
  const auto count = static_cast<double>(std::max<std::size_t>(all.samples, 1));
  return {all.samples, all.largest, all.sum / count, all.largestTexels, all.sumTexels / count};
}

}  // namespace gnomon::exporting
