#include "truth/sample_place.h"

#include <fmt/core.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "common/parallel.h"
#include "common/progress.h"
#include "common/system/memory.h"

namespace gnomon::truth {

SamplePlace SamplePlacer::place(const surface::SurfaceSample& sample) {
  SamplePlace place{sample, false, {}, {}};
  if (!sample.isOnSurface()) return place;
  if (sample.face != lastFace_) {
    // Always its polynomial, so that an answer does not depend on which samples come before it.
    face_.emplace(surface_, sample.face, std::numeric_limits<std::size_t>::max());
    lastFace_ = sample.face;
  }
  place.frame = surface::texelFrame(face_->at(sample.s, sample.t), texelsPerUv_);
  place.facet = mesh_.facet(sample);
  place.defined = place.frame.defined && place.facet.normal != Vec3(0);
  return place;
}

RayStart rayStart(const SamplePlace& place) {
  return {place.facet, place.frame.normal, place.defined};
}

double rayLength(const Vec3& normal, const TexelAxes& axes, const Vec3& light, double texels) {
  const surface::TexelFrame frame{Vec3(0), normal, axes.px, axes.py, Vec2(0), true};
  const surface::LocalLight local = surface::localLight(frame, light);
  const double cosine = 1 / std::hypot(1.0, local.slope);  // |L - (L·n) n|; 0 at the zenith
  return cosine > 0 ? texels * local.worldPerTexel / cosine
                    : std::numeric_limits<double>::infinity();
}

std::size_t placeSamples(SamplePlacer& placer, std::span<const surface::SurfaceSample> samples,
                         std::span<RayStart> starts, std::span<TexelAxes> axes) {
  std::size_t undefined = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const SamplePlace place = placer.place(samples[i]);
    starts[i] = rayStart(place);
    if (!axes.empty()) axes[i] = {place.frame.px, place.frame.py};
    undefined += samples[i].face >= 0 && !place.defined ? 1 : 0;
  }
  return undefined;
}

PlacedSamples placeSamples(const surface::LimitSurface& surface, Vec2 texelsPerUv,
                           const MicroMesh& mesh, const surface::SampleGrid& samples,
                           const Progress& progress) {
  const std::size_t count = samples.samples.size();
  requireMemory(static_cast<double>((sizeof(RayStart) + sizeof(TexelAxes)) * count),
                fmt::format("the places of {} × {} samples", samples.width, samples.height));
  PlacedSamples placed{samples.width,
                       samples.height,
                       RawVector<RayStart>(count),
                       RawVector<TexelAxes>(count),
                       mesh.extent(),
                       0};
  std::atomic<std::size_t> undefined = 0;
  const auto width = static_cast<std::size_t>(samples.width);
  CountedProgress rows(progress, static_cast<std::size_t>(samples.height));
  parallelFor(0, static_cast<std::size_t>(samples.height), [&](std::size_t row) {
    SamplePlacer placer(surface, texelsPerUv, mesh);
    const std::size_t first = row * width;
    undefined += placeSamples(placer, std::span(samples.samples).subspan(first, width),
                              std::span(placed.starts).subspan(first, width),
                              std::span(placed.axes).subspan(first, width));
    rows.advance();
  });
  placed.undefined = undefined;
  return placed;
}

}  // namespace gnomon::truth
