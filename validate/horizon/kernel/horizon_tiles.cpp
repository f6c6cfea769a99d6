#include "horizon/kernel/horizon_tiles.h"

#include <fmt/core.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "horizon/kernel/tile_kernel.h"

namespace gnomon::horizon {
namespace {

constexpr std::size_t groupTaps = AzimuthPlan::groupTaps;
constexpr std::size_t bundleTaps = groupTaps * AzimuthPlan::bundleGroups;

float toleranceAt(double r, const PaddedMap& map) {
  return static_cast<float>(map.tolerance / std::max(r, 1.0));
}

Tap tapOf(const Crossing& c, const PaddedMap& map) {
  return {map.offset(c.from),
          map.offset(c.to),
          static_cast<float>(c.share),
          static_cast<float>(c.leave),
          static_cast<float>(1 / c.leave),
          toleranceAt(c.leave, map)};
}

CellPath pathOf(Node cell, double enter, double leave, Vec2 e, const PaddedMap& map) {
  const double length = leave - enter;
  const double bend = -e.x * e.y;
  return {map.offset(cell),
          static_cast<float>(enter),
          static_cast<float>(length),
          static_cast<float>(enter > 0 ? 1 / enter : 0),
          static_cast<float>(enter * e.x - cell.x),
          static_cast<float>(enter * e.y - cell.y),
          static_cast<float>(bend),
          static_cast<float>(enter > 0 ? 0.25 * bend * length * length / enter : 0)};
}

/// In a cell of bend c the peak exceeds the slope at its end r₁ by c (r₁ - r)² / r₁.
double peakRoom(const Crossing& c, Vec2 e, const PaddedMap& map) {
  if (!(c.enter > 0)) return 0;
  const double bend = -e.x * e.y;
  const double most = std::max(bend * map.highestTwist, bend * map.lowestTwist);
  const double length = c.leave - c.enter;
  return most * length * length / c.leave;
}

/// A stretch with its box still at the ray's own nodes, and the size of that box.
struct Bounded {
  Stretch stretch;
  BoxSize box;
};

Bounded boundCrossings(std::span<const Crossing> crossings, Vec2 e, const PaddedMap& map) {
  Node low = crossings.front().cell;
  Node high = low;
  double room = 0;
  for (const Crossing& c : crossings) {
    low = {std::min(low.x, c.cell.x), std::min(low.y, c.cell.y)};
    high = {std::max(high.x, c.cell.x), std::max(high.y, c.cell.y)};
    room = std::max(room, peakRoom(c, e, map));
  }
  const double enter = crossings.front().enter;
  const double leave = crossings.back().leave;
  return {{low, static_cast<float>(enter), static_cast<float>(leave), static_cast<float>(room),
           toleranceAt(crossings.front().leave, map)},
          {high.x - low.x + 2, high.y - low.y + 2}};
}

/// Cuts a ray into stretches of so many taps, all bounded by boxes of one size.
BoxSize cutStretches(std::span<const Crossing> crossings, std::size_t taps, Vec2 e,
                     const PaddedMap& map, std::vector<Stretch>& stretches) {
  BoxSize box{2, 2};
  for (std::size_t begin = 0; begin < crossings.size(); begin += taps) {
    const std::size_t count = std::min(taps, crossings.size() - begin);
    const Bounded bounded = boundCrossings(crossings.subspan(begin, count), e, map);
    box = {std::max(box.width, bounded.box.width), std::max(box.height, bounded.box.height)};
    stretches.push_back(bounded.stretch);
    stretches.back().corner = map.folded(bounded.stretch.corner);
  }
  return box;
}

}  // namespace

AzimuthPlan planAzimuth(Vec2 direction, double radius, const PaddedMap& map) {
  const RayCrossings ray = cutRay(direction, radius);
  AzimuthPlan plan;
  plan.direction = direction;
  plan.radius = radius;
  for (const Crossing& c : ray.crossings) {
    plan.taps.push_back(tapOf(c, map));
    plan.cells.push_back(pathOf(c.cell, c.enter, c.leave, direction, map));
  }
  while (plan.taps.size() % groupTaps != 0) {
    plan.taps.push_back(plan.taps.back());
    plan.cells.push_back(plan.cells.back());
    plan.cells.back().quarterBulge = 0;
  }
  plan.groupBox = cutStretches(ray.crossings, groupTaps, direction, map, plan.groups);
  plan.bundleBox = cutStretches(ray.crossings, bundleTaps, direction, map, plan.bundles);
  plan.endsInCell = ray.lastEnter < radius;
  plan.lastCell = pathOf(ray.lastCell, ray.lastEnter, radius, direction, map);
  plan.end = {map.folded(ray.lastCell), static_cast<float>(ray.lastEnter),
              static_cast<float>(radius), 0, toleranceAt(radius, map)};
  return plan;
}

double azimuthPlanBytes(double radius) {
  // A ray crosses at most √2 D lattice lines.
  return (sizeof(Crossing) + sizeof(Tap) + sizeof(CellPath)) * (1.5 * radius + 2 + groupTaps);
}

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
