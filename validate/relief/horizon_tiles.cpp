#include "relief/horizon_tiles.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/memory.h"
#include "common/parallel.h"
#include "relief/azimuth_plan.h"
#include "relief/box_maxima.h"
#include "relief/padded_map.h"
#include "relief/ray_crossings.h"

namespace gnomon {
namespace {

/// A padded map with the boxes that bound rays, and what making them takes, over the map alone.
constexpr double boundedMapBytes = 2.2;
constexpr int bundleRowShift = 3;

void checkSettings(const BakeSettings& settings) {
  if (settings.azimuths < 1) {
    throw InputError(
        fmt::format("bake.azimuths: {} found, at least 1 expected", settings.azimuths));
  }
  if (!(settings.radiusTexels > 0) || !std::isfinite(settings.radiusTexels)) {
    throw InputError(fmt::format("bake.radius: {} texels found, a finite number over 0 expected",
                                 settings.radiusTexels));
  }
}

void checkHeights(const HeightField& field) {
  // Differences of differences of heights are taken in floats.
  const double range = static_cast<double>(field.maximum()) - field.minimum();
  if (range > 1e37) {
    throw InputError(fmt::format("height map: heights from {} to {}, at most 1e+37 apart expected",
                                 field.minimum(), field.maximum()));
  }
}

/// Azimuths whose rays are bounded by boxes of the same sizes.
using BoxSizes = std::pair<BoxSize, BoxSize>;
using Classes = std::map<BoxSizes, std::vector<std::size_t>>;

Classes classesOf(const std::vector<AzimuthPlan>& plans) {
  Classes classes;
  for (std::size_t m = 0; m < plans.size(); ++m) {
    classes[{plans[m].groupBox, plans[m].bundleBox}].push_back(m);
  }
  return classes;
}

/// Cuts a map into tiles: what a thread takes at once.
class Tiling {
 public:
  Tiling(int width, int height)
      : width_(width),
        height_(height),
        across_((width + HorizonTile::width - 1) / HorizonTile::width) {}

  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(across_) *
           static_cast<std::size_t>((height_ + HorizonTile::height - 1) / HorizonTile::height);
  }
  [[nodiscard]] TexelTile tile(std::size_t index) const {
    const int left =
        static_cast<int>(index % static_cast<std::size_t>(across_)) * HorizonTile::width;
    const int bottom =
        static_cast<int>(index / static_cast<std::size_t>(across_)) * HorizonTile::height;
    return {left, bottom, std::min(left + HorizonTile::width, width_),
            std::min(bottom + HorizonTile::height, height_)};
  }

 private:
  int width_, height_, across_;
};

/// Counts what is done and reports it, one call at a time.
class Counter {
 public:
  Counter(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}
  void add() {
    if (!progress_) return;
    const std::lock_guard lock(mutex_);
    progress_(static_cast<double>(++done_) / static_cast<double>(total_));
  }

 private:
  const Progress& progress_;
  std::size_t total_;
  std::size_t done_ = 0;
  std::mutex mutex_;
};

}  // namespace

void checkBake(const HeightField& field, const BakeSettings& settings, double tableBytes) {
  checkSettings(settings);
  checkHeights(field);
  const double bytes = tableBytes + boundedMapBytes * paddedMapBytes(field, settings.radiusTexels) +
                       azimuthPlanBytes(settings.radiusTexels) * settings.azimuths;
  requireMemory(
      bytes, fmt::format("bake.azimuths = {} and bake.radius = {} on a map of {} x {} "
                         "texels",
                         settings.azimuths, settings.radiusTexels, field.width(), field.height()));
}

void bakeTiles(const HeightField& field, const BakeSettings& settings, const TileSink& sink,
               const Progress& progress) {
  const PaddedMap map = padMap(field, settings.radiusTexels);
  std::vector<AzimuthPlan> plans(static_cast<std::size_t>(settings.azimuths));
  parallelFor(0, plans.size(), [&](std::size_t m) {
    plans[m] = planAzimuth(azimuthDirection(static_cast<int>(m), settings.azimuths),
                           settings.radiusTexels, map);
  });
  const Tiling tiling(field.width(), field.height());
  Counter counter(progress, tiling.count() * plans.size());
  for (const auto& [boxes, members] : classesOf(plans)) {
    const BoxMaxima groups = boxMaxima(map, boxes.first, 0);
    const BoxMaxima bundles = boxMaxima(map, groups, boxes.second, bundleRowShift);
    parallelFor(0, members.size() * tiling.count(), [&, &members = members](std::size_t index) {
      const std::size_t m = members[index / tiling.count()];
      HorizonTile baked{static_cast<int>(m), tiling.tile(index % tiling.count()), {}, {}};
      bakeTile({map, plans[m], groups, bundles}, baked.tile, HorizonTile::width,
               baked.horizon.data(), baked.distance.data());
      sink(baked);
      counter.add();
    });
  }
}

}  // namespace gnomon
