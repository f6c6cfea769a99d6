#include "truth/sample_place.h"

#include <fmt/core.h>

#include "common/counted_progress.h"
#include "common/memory.h"
#include "common/parallel.h"

namespace gnomon {

SamplePlace samplePlace(const LimitSurface& surface, Vec2 texelsPerUv, const MicroMesh& mesh,
                        const SurfaceSample& sample) {
  SamplePlace place{sample, false, {}, {}};
  if (sample.face < 0) return place;
  place.frame = texelFrame(surface.evaluate(sample.face, sample.s, sample.t), texelsPerUv);
  place.facet = mesh.facet(sample.face, sample.s, sample.t);
  place.defined = place.frame.defined && place.facet.normal != Vec3(0);
  return place;
}

PlacedSamples placeSamples(const LimitSurface& surface, Vec2 texelsPerUv, const MicroMesh& mesh,
                           const SampleGrid& samples, const Progress& progress) {
  requireMemory(static_cast<double>(sizeof(SamplePlace) * samples.samples.size()),
                fmt::format("the places of {} × {} samples", samples.width, samples.height));
  PlacedSamples placed{samples.width, samples.height, {}, mesh.extent()};
  placed.places.resize(samples.samples.size());
  const auto width = static_cast<std::size_t>(samples.width);
  CountedProgress rows(progress, static_cast<std::size_t>(samples.height));
  parallelFor(0, static_cast<std::size_t>(samples.height), [&](std::size_t row) {
    for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
      placed.places[i] = samplePlace(surface, texelsPerUv, mesh, samples.samples[i]);
    }
    rows.advance();
  });
  return placed;
}

}  // namespace gnomon
