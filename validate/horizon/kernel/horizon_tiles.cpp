#include "horizon/kernel/horizon_tiles.h"

#include <fmt/core.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/parallel.h"
#include "common/progress.h"
#include "common/system/memory.h"
#include "horizon/kernel/azimuth_plan.h"
#include "horizon/kernel/padded_map.h"
#include "horizon/kernel/tile_kernel.h"
#include "horizon/reference/height_profile.h"
#include "horizon/reference/ray_crossings.h"

namespace gnomon::horizon {

double tileScratchBytes(double radius) {
  // A ray crosses at most √2 D lattice lines. Of each, a texel may keep the slope, a peak and its
  // r; the lists' entries stand for vectors, at worst of one texel.
  const double taps = 1.5 * radius + 2 + AzimuthPlan::groupTaps;
  const double batch = TexelTile::texels / 2.0;
  return sizeof(TileScratch) +
         batch * taps * (3 * sizeof(float) + sizeof(CellVisit) + sizeof(std::uint32_t)) +
         batch * taps / AzimuthPlan::groupTaps *
             (2 * sizeof(Visit) + sizeof(float) + sizeof(std::uint32_t));
}

namespace {

/// A padded map with the boxes that bound rays, and what making them takes, over the map alone.
constexpr double boundedMapBytes = 2.2;
constexpr int bundleRowShift = 3;

void checkSettings(const BakeSettings& settings) {
  if (settings.azimuths < 1) {
    throw InputError(fmt::format("{} found, at least 1 expected", settings.azimuths), "azimuths");
  }
  if (!(settings.radiusTexels > 0) || !std::isfinite(settings.radiusTexels)) {
    throw InputError(
        fmt::format("{} texels found, a finite number over 0 expected", settings.radiusTexels),
        "radius");
  }
}

void checkHeights(const relief::HeightField& field) {
  // Differences of differences of heights are taken in floats, and past a border of thousands of
  // times the range.
  const double range = static_cast<double>(field.maximum()) - field.minimum();
  if (range > 1e34) {
    throw InputError(fmt::format("height map: heights from {} to {}, at most 1e+34 apart expected",
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

/// Cuts a map into strips of tiles along its rows or columns, whichever is nearer to the rays'
/// direction: most of what the rays of a tile meet, those of the next one meet again.
class Strips {
 public:
  Strips(int width, int height, Vec2 direction)
      : width_(width), height_(height), upright_(std::abs(direction.y) > std::abs(direction.x)) {}

  [[nodiscard]] std::size_t count() const { return upright_ ? columns() : rows(); }
  [[nodiscard]] std::size_t tiles() const { return upright_ ? rows() : columns(); }
  [[nodiscard]] TexelTile tile(std::size_t strip, std::size_t index) const {
    const int left = static_cast<int>(upright_ ? strip : index) * TexelTile::width;
    const int bottom = static_cast<int>(upright_ ? index : strip) * TexelTile::height;
    return {left, bottom, std::min(left + TexelTile::width, width_),
            std::min(bottom + TexelTile::height, height_)};
  }

 private:
  [[nodiscard]] std::size_t columns() const { return parts(width_, TexelTile::width); }
  [[nodiscard]] std::size_t rows() const { return parts(height_, TexelTile::height); }
  static std::size_t parts(int whole, int part) {
    return static_cast<std::size_t>((whole + part - 1) / part);
  }

  int width_, height_;
  bool upright_;
};

/// A strip of the map for one azimuth: what a thread takes at once.
struct Task {
  std::size_t azimuth, strip;
};

std::vector<Task> tasksOf(const std::vector<std::size_t>& azimuths,
                          const std::vector<Strips>& strips) {
  std::vector<Task> tasks;
  for (const std::size_t m : azimuths) {
    for (std::size_t s = 0; s < strips[m].count(); ++s) tasks.push_back({m, s});
  }
  return tasks;
}

/// What a thread bakes its tiles with. It is the same from its first strip to its last, for fresh
/// memory costs more than what is written to it.
struct BakeScratch {
  TileScratch search;
  HorizonTile baked;
};

/// Ends rays at the border of the relief: those whose horizon lies past it, where the padded map
/// goes on for half a texel, are searched again. They are few.
void endAtBorder(const relief::HeightField& field, const AzimuthPlan& plan, HorizonTile& baked) {
  if (!field.border().x && !field.border().y) return;
  const TexelTile& tile = baked.tile;
  for (int y = tile.bottom; y < tile.top; ++y) {
    for (int x = tile.left; x < tile.right; ++x) {
      const auto at =
          static_cast<std::size_t>((y - tile.bottom) * TexelTile::width + x - tile.left);
      const Vec2 centre(x + 0.5, y + 0.5);
      if (baked.distance[at] <= field.knownLength(centre, plan.direction)) continue;
      const FlatHorizon found = flatHorizon(field, centre, plan.direction, plan.radius);
      baked.horizon[at] = static_cast<float>(found.slope);
      baked.distance[at] = static_cast<float>(found.distance);
    }
  }
}

}  // namespace

void checkBake(const relief::HeightField& field, const BakeSettings& settings, double tableBytes) {
  checkSettings(settings);
  checkHeights(field);
  const double bytes = tableBytes + boundedMapBytes * paddedMapBytes(field, settings.radiusTexels) +
                       azimuthPlanBytes(settings.radiusTexels) * settings.azimuths +
                       tileScratchBytes(settings.radiusTexels) * static_cast<double>(threadCount());
  requireMemory(bytes,
                fmt::format("{}, with a radius of {} texels on a map of {} × {}", settings.azimuths,
                            settings.radiusTexels, field.width(), field.height()),
                "azimuths");
}

void bakeTiles(const relief::HeightField& field, const BakeSettings& settings, const TileSink& sink,
               const Progress& progress) {
  const PaddedMap map = padMap(field, settings.radiusTexels);
  std::vector<AzimuthPlan> plans(static_cast<std::size_t>(settings.azimuths));
  parallelFor(0, plans.size(), [&](std::size_t m) {
    plans[m] = planAzimuth(azimuthDirection(static_cast<int>(m), settings.azimuths),
                           settings.radiusTexels, map);
  });
  std::vector<Strips> strips;
  strips.reserve(plans.size());
  for (const AzimuthPlan& plan : plans) {
    strips.emplace_back(field.width(), field.height(), plan.direction);
  }
  CountedProgress counted(progress, strips.front().count() * strips.front().tiles() * plans.size());
  tbb::enumerable_thread_specific<BakeScratch> scratch;
  for (const auto& [boxes, members] : classesOf(plans)) {
    const BoxMaxima groups = boxMaxima(map, boxes.first, 0);
    const BoxMaxima bundles = boxMaxima(map, groups, boxes.second, bundleRowShift);
    const std::vector<Task> tasks = tasksOf(members, strips);
    parallelFor(0, tasks.size(), [&](std::size_t index) {
      const auto [m, strip] = tasks[index];
      const AzimuthBake bake{map, plans[m], groups, bundles};
      auto& [search, baked] = scratch.local();
      baked.azimuth = static_cast<int>(m);
      for (std::size_t t = 0; t < strips[m].tiles(); ++t) {
        baked.tile = strips[m].tile(strip, t);
        bakeTile(bake, baked.tile, search, TexelTile::width, baked.horizon.data(),
                 baked.distance.data());
        endAtBorder(field, plans[m], baked);
        sink(baked);
        counted.advance();
      }
    });
  }
}

}  // namespace gnomon::horizon
