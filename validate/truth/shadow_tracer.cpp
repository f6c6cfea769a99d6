#include "truth/shadow_tracer.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

#include "common/error.h"
#include "common/parallel.h"
#include "surface/texel_frame.h"
#include "truth/flush_denormals.h"

namespace gnomon {
namespace {

constexpr int tileSide = 4;
static_assert(tileSide * tileSide == RayPacket::size);

/// One tile of a view: neighbouring samples make coherent rays.
class TileTracer {
 public:
  TileTracer(const LimitSurface& surface, const Relief& relief, const MicroMesh& mesh,
             const MicroScene& scene, const SampleGrid& samples, const TraceSettings& settings)
      : surface_(surface),
        texelsPerUv_(relief.texelsPerUv()),
        mesh_(mesh),
        scene_(scene),
        samples_(samples),
        settings_(settings),
        lift_(settings.liftShare * mesh.extent()) {}

  void trace(int tileColumn, int tileRow, Truth& truth) const {
    RayPacket packet{};
    std::array<double, RayPacket::size> reach{};
    for (int k = 0; k < RayPacket::size; ++k) {
      const int column = tileColumn * tileSide + k % tileSide;
      const int row = tileRow * tileSide + k / tileSide;
      if (column >= samples_.width || row >= samples_.height) continue;
      prepare(index(column, row), static_cast<std::size_t>(k), packet, reach, truth);
    }
    answer(tileColumn, tileRow, packet, reach, truth);
  }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(samples_.width) +
           static_cast<std::size_t>(column);
  }

  /// Settles what needs no ray and fills the packet with the rest.
  void prepare(std::size_t i, std::size_t k, RayPacket& packet,
               std::array<double, RayPacket::size>& reach, Truth& truth) const {
    const SurfaceSample& sample = samples_.samples[i];
    if (sample.face < 0) return;
    const TexelFrame frame =
        texelFrame(surface_.evaluate(sample.face, sample.s, sample.t), texelsPerUv_);
    const Facet facet = mesh_.facet(sample.face, sample.s, sample.t);
    if (!frame.defined || facet.normal == Vec3(0)) return;  // stays Shade::none
    const bool beyond = glm::dot(frame.normal, settings_.light) <= 0;
    const bool turned = glm::dot(facet.normal, settings_.light) <= 0;
    truth.regions[i] = beyond ? Region::beyondTerminator : turned ? Region::attached : Region::lit;
    truth.mask.samples[i] = turned ? Shade::shadowed : Shade::lit;
    if (turned) return;
    packet.active.at(k) = true;
    packet.origins.at(k) = facet.point + lift_ * facet.normal;
    packet.lengths.at(k) = std::numeric_limits<double>::infinity();
    reach.at(k) = rayLengthOfRadius(frame);
  }

  /// Length of the ray whose trace on the tangent plane is D texels long.
  [[nodiscard]] double rayLengthOfRadius(const TexelFrame& frame) const {
    const LocalLight local = localLight(frame, settings_.light);
    const double cosine =
        1 / std::hypot(1.0, local.slope);  // |L - (L·n) n|; 0 for a light at the zenith
    return cosine > 0 ? settings_.radiusTexels * local.worldPerTexel / cosine
                      : std::numeric_limits<double>::infinity();
  }

  void answer(int tileColumn, int tileRow, RayPacket& packet,
              const std::array<double, RayPacket::size>& reach, Truth& truth) const {
    const auto blocked = scene_.occluded(packet, settings_.light);
    // A second, shorter ray tells occluders within D from those beyond.
    packet.active = blocked;
    packet.lengths = reach;
    const auto blockedNearby = scene_.occluded(packet, settings_.light);
    for (int k = 0; k < RayPacket::size; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      if (!blocked.at(lane)) continue;
      const std::size_t i =
          index(tileColumn * tileSide + k % tileSide, tileRow * tileSide + k / tileSide);
      truth.mask.samples[i] = Shade::shadowed;
      if (truth.regions[i] == Region::lit) {
        truth.regions[i] = blockedNearby.at(lane) ? Region::cast : Region::distant;
      }
    }
  }

  const LimitSurface& surface_;
  Vec2 texelsPerUv_;
  const MicroMesh& mesh_;
  const MicroScene& scene_;
  const SampleGrid& samples_;
  const TraceSettings& settings_;
  double lift_;
};

std::size_t countUndefined(const SampleGrid& samples, const Mask& mask) {
  std::size_t undefined = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    undefined += samples.samples[i].face >= 0 && mask.samples[i] == Shade::none ? 1 : 0;
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

Truth traceShadows(const LimitSurface& surface, const Relief& relief, const MicroMesh& mesh,
                   const MicroScene& scene, const SampleGrid& samples,
                   const TraceSettings& settings, const Progress& progress) {
  Truth truth;
  truth.mask = {samples.width, samples.height,
                std::vector<Shade>(samples.samples.size(), Shade::none)};
  truth.regions.assign(samples.samples.size(), Region::none);
  const TileTracer tracer(surface, relief, mesh, scene, samples, settings);
  const int tileColumns = (samples.width + tileSide - 1) / tileSide;
  const int tileRows = (samples.height + tileSide - 1) / tileSide;
  std::mutex reporting;
  int done = 0;
  parallelFor(0, static_cast<std::size_t>(tileRows), [&](std::size_t row) {
    const FlushDenormals flush;
    for (int column = 0; column < tileColumns; ++column) {
      tracer.trace(column, static_cast<int>(row), truth);
    }
    if (progress) {
      const std::scoped_lock lock(reporting);
      progress(static_cast<double>(++done) / tileRows);
    }
  });
  truth.undefinedSamples = countUndefined(samples, truth.mask);
  return truth;
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
