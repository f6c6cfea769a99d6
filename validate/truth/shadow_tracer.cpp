#include "truth/shadow_tracer.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "truth/embree.h"

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

namespace {

constexpr std::size_t tileSide = 4;

/// Up to four rows of a view's samples.
struct Band {
  std::span<const RayStart> starts;
  std::size_t width;
  std::size_t first;  ///< the view's sample that is the band's first
};

/// Calls `work` for the index of every sample of a band, tile after tile: neighbours on the surface
/// make coherent rays.
template <typename Work>
void forEachInTiles(const Band& band, const Work& work) {
  for (std::size_t left = 0; left < band.width; left += tileSide) {
    const std::size_t right = std::min(left + tileSide, band.width);
    for (std::size_t row = 0; row < band.starts.size(); row += band.width) {
      for (std::size_t i = row + left; i < row + right; ++i) work(i);
    }
  }
}

/// Traces one band under one light. Rays wait until sixteen are there.
class BandTracer {
 public:
  BandTracer(const MicroScene& scene, double extent, const TraceSettings& settings,
             const Band& band, Truth& truth)
      : scene_(scene),
        settings_(settings),
        rayOffset_(settings.rayOffset * extent),
        band_(band),
        truth_(truth) {}

  void trace() {
    forEachInTiles(band_, [this](std::size_t i) { begin(i); });
    traceWaiting();
  }

 private:
  /// Settles what needs no ray.
  void begin(std::size_t i) {
    const RayStart& start = band_.starts[i];
    if (!start.defined) return;  // stays Shade::none
    const bool beyond = glm::dot(start.normal, settings_.light.direction) <= 0;
    const bool turned = start.facet.facesAwayFrom(settings_.light.direction);
    region(i) = beyond ? Region::beyondTerminator : turned ? Region::attached : Region::lit;
    shade(i) = turned ? Shade::shadowed : Shade::lit;
    if (turned) return;
    samples_[rays_.count] = i;
    rays_.add(start.facet.rayOrigin(rayOffset_));
    if (rays_.count == RayPacket::size) traceWaiting();
  }

  void traceWaiting() {
    if (rays_.count == 0) return;
    const auto blocked = scene_.occluded(rays_, settings_.light.direction);
    for (std::size_t k = 0; k < rays_.count; ++k) {
      if (!blocked[k]) continue;
      const std::size_t i = samples_[k];
      shade(i) = Shade::shadowed;
      if (region(i) == Region::lit) region(i) = Region::cast;
    }
    rays_.count = 0;
  }

  [[nodiscard]] Shade& shade(std::size_t i) { return truth_.mask.samples[band_.first + i]; }
  [[nodiscard]] Region& region(std::size_t i) { return truth_.regions[band_.first + i]; }

  const MicroScene& scene_;
  const TraceSettings& settings_;
  double rayOffset_;  ///< world length
  Band band_;
  Truth& truth_;
  RayPacket rays_{};
  std::array<std::size_t, RayPacket::size> samples_{};  ///< of the band, one a ray
};

Truth emptyTruth(int width, int height) {
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Truth truth;
  truth.mask = {width, height, std::vector<Shade>(count, Shade::none)};
  truth.regions.assign(count, Region::none);
  return truth;
}

/// Calls `work(first, count)` for every band: the samples of up to four rows.
template <typename Work>
void forEachBand(int width, int height, const Progress& progress, const Work& work) {
  const auto rows = static_cast<std::size_t>(height);
  const std::size_t bands = (rows + tileSide - 1) / tileSide;
  CountedProgress done(progress, bands);
  parallelFor(0, bands, [&](std::size_t band) {
    const FlushDenormals flush;
    const std::size_t firstRow = band * tileSide;
    work(firstRow * static_cast<std::size_t>(width),
         std::min<std::size_t>(tileSide, rows - firstRow) * static_cast<std::size_t>(width));
    done.advance();
  });
}

}  // namespace

void Truth::answerBy(Visibility shares) {
  mask = cutInHalf(shares);
  visibility = std::move(shares);
}

Truth traceShadows(const MicroScene& scene, const PlacedSamples& placed,
                   const TraceSettings& settings, const Progress& progress) {
  Truth truth = emptyTruth(placed.width, placed.height);
  forEachBand(placed.width, placed.height, progress, [&](std::size_t first, std::size_t count) {
    const Band band{std::span(placed.starts).subspan(first, count),
                    static_cast<std::size_t>(placed.width), first};
    BandTracer(scene, placed.extent, settings, band, truth).trace();
  });
  truth.undefinedSamples = placed.undefined;
  return truth;
}

std::vector<Truth> traceShadows(const surface::LimitSurface& surface, const relief::Relief& relief,
                                const MicroMesh& mesh, const MicroScene& scene,
                                const surface::SampleGrid& samples,
                                std::span<const TraceSettings> lights, const Progress& progress) {
  std::vector<Truth> truths(lights.size(), emptyTruth(samples.width, samples.height));
  std::atomic<std::size_t> undefined = 0;
  forEachBand(samples.width, samples.height, progress, [&](std::size_t first, std::size_t count) {
    SamplePlacer placer(surface, relief.texelsPerUv(), mesh);
    RawVector<RayStart> starts(count);
    undefined += placeSamples(placer, std::span(samples.samples).subspan(first, count), starts);
    const Band band{starts, static_cast<std::size_t>(samples.width), first};
    for (std::size_t l = 0; l < lights.size(); ++l) {
      throwIfCancelled();
      BandTracer(scene, mesh.extent(), lights[l], band, truths[l]).trace();
    }
  });
  for (Truth& truth : truths) truth.undefinedSamples = undefined;
  return truths;
}

Truth traceShadows(const surface::LimitSurface& surface, const relief::Relief& relief,
                   const MicroMesh& mesh, const MicroScene& scene,
                   const surface::SampleGrid& samples, const TraceSettings& settings,
                   const Progress& progress) {
  return std::move(
      traceShadows(surface, relief, mesh, scene, samples, std::span(&settings, 1), progress)
          .front());
}

double flipRate(const Mask& a, const Mask& b) {
  if (a.width != b.width || a.height != b.height) {
    throw InternalError("flip rate of masks of different sizes");
  }
  std::size_t flips = 0;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.samples[i] == Shade::none || b.samples[i] == Shade::none) continue;
    ++compared;
    flips += a.samples[i] != b.samples[i] ? 1 : 0;
  }
  return compared == 0 ? 0.0 : static_cast<double>(flips) / static_cast<double>(compared);
}

std::optional<Occluder> firstOccluder(const surface::LimitSurface& surface,
                                      const relief::Relief& relief, const MicroMesh& mesh,
                                      const MicroScene& scene, const OccluderQuery& query) {
  SamplePlacer placer(surface, relief.texelsPerUv(), mesh);
  const SamplePlace place = placer.place(query.sample);
  if (!place.defined) return std::nullopt;
  const Facet& facet = place.facet;
  if (facet.facesAwayFrom(query.light)) {
    return Occluder{mesh.centre() + facet.point, 0, true};
  }
  const Vec3 origin = facet.rayOrigin(mesh.rayOffset(query.rayOffset));
  const auto hit = scene.nearest(origin, query.light);
  if (!hit) return std::nullopt;
  return Occluder{mesh.centre() + origin + hit->distance * query.light, hit->distance, false};
}

}  // namespace gnomon::truth
