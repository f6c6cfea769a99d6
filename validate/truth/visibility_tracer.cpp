#include "truth/visibility_tracer.h"

#include <fmt/core.h>

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
std::uint32_t seenFrom(const MicroScene& scene, const Facet& facet, double rayOffset,
                       std::span<const Vec3> directions) {
  const Vec3 origin = facet.rayOrigin(rayOffset);
  std::uint32_t seen = 0;
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

void requireSound(const surface::SampleGrid& samples, const Mask& where,
                  const DiscSettings& settings) {
  if (where.width != samples.width || where.height != samples.height ||
      where.size() != samples.samples.size()) {
    throw InternalError("a mask of another view than the samples of a soft light");
  }
  if (settings.coarse < 1 || settings.coarse > settings.directions) {
    throw InternalError(fmt::format("{} of {} directions come first: 1 to all expected",
                                    settings.coarse, settings.directions));
  }
}

/// The two passes over the samples of a view.
class DiscTracer {
 public:
  DiscTracer(const MicroMesh& mesh, const MicroScene& scene, const surface::SampleGrid& samples,
             const Mask& where, const DiscSettings& settings)
      : mesh_(mesh),
        scene_(scene),
        samples_(samples),
        where_(where),
        rayOffset_(mesh.rayOffset(settings.rayOffset)),
        directions_(
            discDirections(settings.light, settings.radius, discPoints(settings.directions))),
        rim_(discDirections(settings.light, settings.radius, discRim(rimDirections))),
        coarse_(static_cast<std::size_t>(settings.coarse)),
        begun_(samples.samples.size()) {}

  Visibility trace(const Progress& progress) {
    const auto height = static_cast<std::size_t>(samples_.height);
    const std::size_t bands = (height + bandRows - 1) / bandRows;
    CountedProgress done(progress, 2 * bands);
    const auto forEachSample = [&](const auto& work) {
      parallelFor(0, bands, [&](std::size_t band) {
        const FlushDenormals flush;
        const std::size_t end = std::min(height, (band + 1) * bandRows) * width();
        for (std::size_t i = band * bandRows * width(); i < end; ++i) {
          if (where_.samples[i] != Shade::none) work(i);
        }
        done.advance();
      });
    };
    const std::span<const Vec3> all(directions_);
    forEachSample([&](std::size_t i) { begun_[i] = begin(i); });
    Visibility found{samples_.width, samples_.height,
                     std::vector<float>(samples_.samples.size(), noSample)};
    forEachSample([&](std::size_t i) {
      found.shares[i] = isSettled(i) ? (begun_[i].seen == 0 ? 0.0F : 1.0F)
                                     : share(begun_[i].seen + seenOf(i, all.subspan(coarse_)));
    });
    return found;
  }

 private:
  /// What a sample sees of the directions that come first.
  struct Begun {
    std::uint32_t seen;  ///< of those that count
    bool agrees;         ///< it sees all, or none, those of the rim too
  };

  [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(samples_.width); }

  [[nodiscard]] std::uint32_t seenOf(std::size_t i, std::span<const Vec3> directions) const {
    return seenFrom(scene_, mesh_.facet(samples_.samples[i]), rayOffset_, directions);
  }

  [[nodiscard]] Begun begin(std::size_t i) const {
    const std::uint32_t seen = seenOf(i, std::span(directions_).first(coarse_));
    const std::uint32_t all = seen + seenOf(i, rim_);
    return {seen, all == 0 || all == coarse_ + rim_.size()};
  }

  [[nodiscard]] float share(std::uint32_t seen) const {
    return static_cast<float>(seen) / static_cast<float>(directions_.size());
  }

  /// Whether the directions that come first of a sample and of all its neighbours agree.
  [[nodiscard]] bool isSettled(std::size_t i) const {
    if (coarse_ == directions_.size() || !begun_[i].agrees) return false;
    const auto column = static_cast<int>(i % width());
    const auto row = static_cast<int>(i / width());
    for (int y = std::max(0, row - 1); y < std::min(samples_.height, row + 2); ++y) {
      for (int x = std::max(0, column - 1); x < std::min(samples_.width, column + 2); ++x) {
        const std::size_t other =
            static_cast<std::size_t>(y) * width() + static_cast<std::size_t>(x);
        if (where_.samples[other] == Shade::none) continue;
        if (!begun_[other].agrees || begun_[other].seen != begun_[i].seen) return false;
      }
    }
    return true;
  }

  const MicroMesh& mesh_;
  const MicroScene& scene_;
  const surface::SampleGrid& samples_;
  const Mask& where_;
  double rayOffset_;
  std::vector<Vec3> directions_;
  std::vector<Vec3> rim_;
  std::size_t coarse_;
  std::vector<Begun> begun_;  ///< one a sample
};

}  // namespace

Visibility traceVisibility(const MicroMesh& mesh, const MicroScene& scene,
                           const surface::SampleGrid& samples, const Mask& where,
                           const DiscSettings& settings, const Progress& progress) {
  requireSound(samples, where, settings);
  return DiscTracer(mesh, scene, samples, where, settings).trace(progress);
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

}  // namespace gnomon::truth
