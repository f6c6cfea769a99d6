#include "truth/shadow_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/counted_progress.h"
#include "common/error.h"
#include "common/parallel.h"
#include "surface/texel_frame.h"
#include "truth/flush_denormals.h"

namespace gnomon {
namespace {

constexpr std::size_t tileSide = 4;
static_assert(tileSide * tileSide == RayPacket::size);

/// Up to four rows of a view's samples.
struct Band {
  std::span<const SamplePlace> places;
  std::size_t width;
  std::size_t first;  ///< the view's sample that is the band's first
};

/// Traces a band tile by tile: neighbouring samples make coherent rays.
class BandTracer {
 public:
  BandTracer(const MicroScene& scene, double extent, const TraceSettings& settings)
      : scene_(scene), settings_(settings), lift_(settings.liftShare * extent) {}

  void trace(const Band& band, Truth& truth) const {
    for (std::size_t column = 0; column < band.width; column += tileSide) {
      traceTile(band, column, truth);
    }
  }

 private:
  void traceTile(const Band& band, std::size_t firstColumn, Truth& truth) const {
    RayPacket packet{};
    std::array<std::size_t, RayPacket::size> at{};  // the band's sample of each ray
    for (std::size_t k = 0; k < RayPacket::size; ++k) {
      const std::size_t column = firstColumn + k % tileSide;
      at.at(k) = k / tileSide * band.width + column;
      if (column >= band.width || at.at(k) >= band.places.size()) continue;
      prepare(band.places[at.at(k)], band.first + at.at(k), k, packet, truth);
    }
    const auto blocked = scene_.occluded(packet, settings_.light);
    // A second, shorter ray tells occluders within D from those beyond.
    packet.active = blocked;
    for (std::size_t k = 0; k < RayPacket::size; ++k) {
      if (blocked.at(k)) packet.lengths.at(k) = rayLengthOfRadius(band.places[at.at(k)].frame);
    }
    const auto blockedNearby = scene_.occluded(packet, settings_.light);
    for (std::size_t k = 0; k < RayPacket::size; ++k) {
      if (!blocked.at(k)) continue;
      const std::size_t i = band.first + at.at(k);
      truth.mask.samples[i] = Shade::shadowed;
      if (truth.regions[i] == Region::lit) {
        truth.regions[i] = blockedNearby.at(k) ? Region::cast : Region::distant;
      }
    }
  }

  /// Settles what needs no ray and fills the packet with the rest.
  void prepare(const SamplePlace& place, std::size_t i, std::size_t k, RayPacket& packet,
               Truth& truth) const {
    if (!place.defined) return;  // stays Shade::none
    const bool beyond = glm::dot(place.frame.normal, settings_.light) <= 0;
    const bool turned = glm::dot(place.facet.normal, settings_.light) <= 0;
    truth.regions[i] = beyond ? Region::beyondTerminator : turned ? Region::attached : Region::lit;
    truth.mask.samples[i] = turned ? Shade::shadowed : Shade::lit;
    if (turned) return;
    packet.active.at(k) = true;
    packet.origins.at(k) = place.facet.point + lift_ * place.facet.normal;
    packet.lengths.at(k) = std::numeric_limits<double>::infinity();
  }

  /// Length of the ray whose trace on the tangent plane is D texels long.
  [[nodiscard]] double rayLengthOfRadius(const TexelFrame& frame) const {
    const LocalLight local = localLight(frame, settings_.light);
    const double cosine =
        1 / std::hypot(1.0, local.slope);  // |L - (L·n) n|; 0 for a light at the zenith
    return cosine > 0 ? settings_.radiusTexels * local.worldPerTexel / cosine
                      : std::numeric_limits<double>::infinity();
  }

  const MicroScene& scene_;
  const TraceSettings& settings_;
  double lift_;
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

/// @param faceOf  the face of a sample, -1 where there is none
template <typename FaceOf>
std::size_t countUndefined(const Mask& mask, const FaceOf& faceOf) {
  std::size_t undefined = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    undefined += faceOf(i) >= 0 && mask.samples[i] == Shade::none ? 1 : 0;
  }
  return undefined;
}

}  // namespace

std::string_view regionName(Region region) {
  switch (region) {
    case Region::none:
      return "none";
    case Region::lit:
      return "lit";
    case Region::attached:
      return "attached";
    case Region::cast:
      return "cast";
    case Region::distant:
      return "distant";
    case Region::beyondTerminator:
      return "beyond-terminator";
  }
  throw InternalError("a region without a name");
}

Truth traceShadows(const MicroScene& scene, const PlacedSamples& placed,
                   const TraceSettings& settings, const Progress& progress) {
  Truth truth = emptyTruth(placed.width, placed.height);
  const BandTracer tracer(scene, placed.extent, settings);
  const std::span places(placed.places);
  forEachBand(placed.width, placed.height, progress, [&](std::size_t first, std::size_t count) {
    tracer.trace({places.subspan(first, count), static_cast<std::size_t>(placed.width), first},
                 truth);
  });
  truth.undefinedSamples =
      countUndefined(truth.mask, [&](std::size_t i) { return placed.places[i].sample.face; });
  return truth;
}

std::vector<Truth> traceShadows(const LimitSurface& surface, const Relief& relief,
                                const MicroMesh& mesh, const MicroScene& scene,
                                const SampleGrid& samples, std::span<const TraceSettings> lights,
                                const Progress& progress) {
  const Vec2 texelsPerUv = relief.texelsPerUv();
  std::vector<BandTracer> tracers;
  for (const TraceSettings& light : lights) tracers.emplace_back(scene, mesh.extent(), light);
  std::vector<Truth> truths(lights.size(), emptyTruth(samples.width, samples.height));
  forEachBand(samples.width, samples.height, progress, [&](std::size_t first, std::size_t count) {
    std::vector<SamplePlace> places;
    places.reserve(count);
    for (std::size_t i = first; i < first + count; ++i) {
      places.push_back(samplePlace(surface, texelsPerUv, mesh, samples.samples[i]));
    }
    for (std::size_t l = 0; l < tracers.size(); ++l) {
      tracers[l].trace({places, static_cast<std::size_t>(samples.width), first}, truths[l]);
    }
  });
  for (Truth& truth : truths) {
    truth.undefinedSamples =
        countUndefined(truth.mask, [&](std::size_t i) { return samples.samples[i].face; });
  }
  return truths;
}

Truth traceShadows(const LimitSurface& surface, const Relief& relief, const MicroMesh& mesh,
                   const MicroScene& scene, const SampleGrid& samples,
                   const TraceSettings& settings, const Progress& progress) {
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

}  // namespace gnomon
