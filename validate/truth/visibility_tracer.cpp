#include "truth/visibility_tracer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "common/counted_progress.h"
#include "common/error.h"
#include "common/parallel.h"
#include "truth/disc_directions.h"
#include "truth/flush_denormals.h"

namespace gnomon::truth {
namespace {

constexpr std::size_t bandRows = 4;

/// How many of some directions a facet's point sees.
std::size_t seenFrom(const MicroScene& scene, const Facet& facet, double rayOffset,
                     std::span<const Vec3> directions) {
  const Vec3 origin = facet.rayOrigin(rayOffset);
  std::size_t seen = 0;
  RayBundle rays{};
  const auto trace = [&] {
    if (rays.count == 0) return;
    seen += static_cast<std::uint32_t>(rays.count -
                                       scene.occluded(rays, embree::Rays::coherent).count());
    rays.count = 0;
  };
  for (const Vec3& direction : directions) {
    if (facet.facesAwayFrom(direction)) continue;
    rays.add(origin, direction);
    if (rays.count == RayPacket::size) trace();
  }
  trace();
  return seen;
}

/// What the directions that come first say of a sample.
enum class Begun : std::uint8_t { nothing, dark, lit, mixed };

/// The two passes over the points of a view.
/// @tparam FacetOf  gives the facet that holds the point of an index
template <typename FacetOf>
class DiscTracer {
 public:
  /// @param rayOffset  world length
  DiscTracer(const MicroScene& scene, const Mask& hard, const DiscSettings& settings,
             double rayOffset, FacetOf facetOf)
      : scene_(scene),
        hard_(hard),
        rayOffset_(rayOffset),
        facetOf_(facetOf),
        directions_(
            discDirections(settings.light, settings.radius, discPoints(settings.directions))),
        rim_(discDirections(settings.light, settings.radius, discRim(rimDirections))),
        isAdaptive_(settings.isAdaptive),
        begun_(hard.size(), Begun::nothing) {}

  Visibility trace(const Progress& progress) {
    const auto height = static_cast<std::size_t>(hard_.height);
    const std::size_t bands = (height + bandRows - 1) / bandRows;
    CountedProgress done(progress, 2 * bands);
    const auto forEachSample = [&](const auto& work) {
      parallelFor(0, bands, [&](std::size_t band) {
        const FlushDenormals flush;
        const std::size_t end = std::min(height, (band + 1) * bandRows) * width();
        for (std::size_t i = band * bandRows * width(); i < end; ++i) {
          if (hard_.samples[i] != Shade::none) work(i);
        }
        done.advance();
      });
    };
    forEachSample([&](std::size_t i) { begun_[i] = isAdaptive_ ? begin(i) : Begun::mixed; });
    Visibility found{hard_.width, hard_.height, std::vector<float>(hard_.size(), noSample)};
    forEachSample([&](std::size_t i) {
      found.shares[i] = !isSettled(i) ? shareOf(i) : begun_[i] == Begun::dark ? 0.0F : 1.0F;
    });
    return found;
  }

 private:
  [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(hard_.width); }

  [[nodiscard]] std::size_t seenOf(std::size_t i, std::span<const Vec3> directions) const {
    return seenFrom(scene_, facetOf_(i), rayOffset_, directions);
  }

  [[nodiscard]] float shareOf(std::size_t i) const {
    return static_cast<float>(seenOf(i, directions_)) / static_cast<float>(directions_.size());
  }

  [[nodiscard]] Begun begin(std::size_t i) const {
    const std::size_t seen = seenOf(i, rim_);
    const bool isLit = hard_.samples[i] == Shade::lit;
    if (seen != (isLit ? rim_.size() : 0)) return Begun::mixed;
    return isLit ? Begun::lit : Begun::dark;
  }

  /// Whether a sample and all its neighbours agree.
  [[nodiscard]] bool isSettled(std::size_t i) const {
    if (begun_[i] == Begun::mixed) return false;
    const auto column = static_cast<int>(i % width());
    const auto row = static_cast<int>(i / width());
    for (int y = std::max(0, row - 1); y < std::min(hard_.height, row + 2); ++y) {
      for (int x = std::max(0, column - 1); x < std::min(hard_.width, column + 2); ++x) {
        const Begun other =
            begun_[static_cast<std::size_t>(y) * width() + static_cast<std::size_t>(x)];
        if (other != Begun::nothing && other != begun_[i]) return false;
      }
    }
    return true;
  }

  const MicroScene& scene_;
  const Mask& hard_;
  double rayOffset_;
  FacetOf facetOf_;
  std::vector<Vec3> directions_;
  std::vector<Vec3> rim_;
  bool isAdaptive_;
  std::vector<Begun> begun_;  ///< one a point
};

/// @throws InternalError unless the mask has one answer for each point of the view
void requireView(const Mask& hard, int width, int height, std::size_t points) {
  if (hard.width == width && hard.height == height && hard.size() == points) return;
  throw InternalError("a mask of another view than the points of a soft light");
}

}  // namespace

Visibility traceVisibility(const MicroMesh& mesh, const MicroScene& scene,
                           const surface::SampleGrid& samples, const Mask& hard,
                           const DiscSettings& settings, const Progress& progress) {
  requireView(hard, samples.width, samples.height, samples.samples.size());
  return DiscTracer(scene, hard, settings, mesh.rayOffset(settings.rayOffset),
                    [&](std::size_t i) { return mesh.facet(samples.samples[i]); })
      .trace(progress);
}

Visibility traceVisibility(const SeenSurface& seen, const MicroScene& scene, const Mask& hard,
                           const DiscSettings& settings, const Progress& progress) {
  requireView(hard, seen.width, seen.height, seen.points.size());
  return DiscTracer(scene, hard, settings, seen.rayOffset,
                    [&](std::size_t i) { return seen.points[i].facet; })
      .trace(progress);
}

ShareChange shareChange(const Visibility& a, const Visibility& b) {
  if (a.width != b.width || a.height != b.height || a.size() != b.size()) {
    throw InternalError("change of shares between maps of different sizes");
  }
  std::vector<double> changes;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a.shares[i]) || std::isnan(b.shares[i])) continue;
    changes.push_back(
        std::abs(static_cast<double>(a.shares[i]) - static_cast<double>(b.shares[i])));
    sum += changes.back();
  }
  if (changes.empty()) return {};
  // In integers: ⌈0.99 n⌉ of them do not exceed it.
  const std::size_t place = (99 * changes.size() + 99) / 100 - 1;
  std::nth_element(changes.begin(), changes.begin() + static_cast<std::ptrdiff_t>(place),
                   changes.end());
  return {sum / static_cast<double>(changes.size()), changes[place]};
}

double uncertaintyOf(const Truth& truth, const Truth& coarse) {
  return truth.isSoft() ? shareChange(truth.visibility, coarse.visibility).mean
                        : flipRate(truth.mask, coarse.mask);
}

}  // namespace gnomon::truth
