#include "horizon/kernel/tile_kernel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

// This file is compiled once for each instruction set that gives other code here; the processor
// that runs it decides. SSSE3 has no wider vectors than SSE4, which all such processors but the
// oldest have, and AVX3_DL adds to AVX-512 only instructions that are not used here.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "horizon/kernel/tile_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "horizon/kernel/tile_peaks_inl.h"
#include "horizon/kernel/tile_vectors_inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::horizon {
namespace HWY_NAMESPACE {
namespace {

Tile openTile(const AzimuthBake& bake, const TexelTile& tile, TileScratch& scratch) {
  const PaddedMap& map = bake.map;
  const std::size_t vector = hn::Lanes(lanes);
  const auto width = static_cast<std::size_t>(tile.right - tile.left);
  const std::size_t across = (width + vector - 1) / vector;
  std::size_t v = 0;
  for (int y = tile.bottom; y < tile.top; ++y) {
    for (std::size_t x = 0; x < across; ++x, ++v) {
      const std::ptrdiff_t row = map.marginY + y;
      const std::ptrdiff_t column =
          map.marginX + tile.left + static_cast<std::ptrdiff_t>(x * vector);
      scratch.row[v] = static_cast<std::int32_t>(row);
      scratch.column[v] = static_cast<std::int32_t>(column);
      scratch.offset[v] = row * map.stride + column;
    }
  }
  scratch.winners.clear();
  scratch.foreseen.assign(v * bake.plan.bundles.size(), 0);
  return {bake, bake.plan, scratch, across, static_cast<std::size_t>(tile.top - tile.bottom)};
}

/// The limit r → 0⁺: the directional derivative.
HWY_INLINE Floats derivative(const Tile& at, const float* heights, Floats height) {
  const Vec2 e = at.plan.direction;
  const std::ptrdiff_t stride = at.bake.map.stride;
  const Floats x = hn::Sub(hn::LoadU(lanes, heights + (e.x < 0 ? -1 : 1)), height);
  const Floats y = hn::Sub(hn::LoadU(lanes, heights + (e.y < 0 ? -stride : stride)), height);
  return hn::Add(hn::Mul(hn::Set(lanes, static_cast<float>(std::abs(e.x))), x),
                 hn::Mul(hn::Set(lanes, static_cast<float>(std::abs(e.y))), y));
}

/// Vectors of a batch with the slopes that they start from.
void openStep(Tile& at, std::size_t firstRow, std::size_t step) {
  TileScratch& scratch = at.scratch;
  scratch.batchCount = 0;
  for (std::size_t y = firstRow; y < at.rows; y += step) {
    for (std::size_t x = 0; x < at.across; ++x) {
      const std::size_t v = y * at.across + x;
      const float* heights = at.heights(v);
      const Floats height = hn::LoadU(lanes, heights);
      const Floats start = derivative(at, heights, height);
      store(height, scratch.height.data(), v);
      store(start, scratch.start.data(), v);
      store(start, scratch.best.data(), v);
      scratch.batch[scratch.batchCount++] = static_cast<Index>(v);
    }
  }
  scratch.keptCount = 0;
  scratch.peakCount = 0;
}

// --- groups of taps -----------------------------------------------------------------------------

/// Finds the slopes of groups, and keeps those that may attain a horizon at a tap or beside one.
HWY_NOINLINE void takeGroups(Tile& at, std::size_t count) {
  TileScratch& scratch = at.scratch;
  const std::size_t vector = hn::Lanes(lanes);
  const Visit* visits = scratch.visits.data();
  Visit* kept = roomFor(scratch.kept, scratch.keptCount + count);
  float* allSlopes = roomFor(scratch.slopes, (scratch.keptCount + count) * groupTaps * vector);
  float* allHighest = roomFor(scratch.highest, (scratch.keptCount + count) * vector);
  std::size_t keptCount = scratch.keptCount;
  for (std::size_t i = 0; i < count; ++i) {
    const Visit visit = visits[i];
    const Stretch& group = at.plan.groups[visit.group];
    const Tap* taps = at.plan.taps.data() + visit.group * groupTaps;
    const float* heights = at.heights(visit.vector);
    const Floats height = at.height(visit.vector);
    float* slopes = allSlopes + keptCount * groupTaps * vector;
    Floats highest = hn::Set(lanes, -never);
    for (std::size_t k = 0; k < groupTaps; ++k) {
      const Floats slope = slopeAt(heights, height, taps[k]);
      store(slope, slopes, k);
      highest = hn::Max(highest, slope);
    }
    const Floats best = hn::Max(at.best(visit.vector), highest);
    store(best, scratch.best.data(), visit.vector);
    store(highest, allHighest, keptCount);
    kept[keptCount] = visit;
    const Floats least = hn::Sub(best, hn::Set(lanes, group.tolerance + group.peakRoom));
    keptCount += hn::AllFalse(lanes, hn::Ge(highest, least)) ? 0 : 1;
  }
  scratch.keptCount = keptCount;
}

/// Takes the groups that won in rows at some distance below, so that most others need no look.
HWY_INLINE void takeForeseen(Tile& at, std::size_t rowsBelow) {
  TileScratch& scratch = at.scratch;
  Visit* visits = roomFor(scratch.visits, scratch.winners.size());
  std::size_t count = 0;
  for (const Visit& winner : scratch.winners) {
    const std::size_t v = winner.vector + rowsBelow * at.across;
    if (v >= at.rows * at.across) continue;
    visits[count++] = {static_cast<Index>(v), winner.group};
    scratch.foreseen[v * at.plan.bundles.size() + winner.group / bundleGroups] |=
        static_cast<std::uint8_t>(1U << (winner.group % bundleGroups));
  }
  takeGroups(at, count);
}

/// Whether a height up to `highest` between two distances could equal or exceed any horizon.
HWY_INLINE bool canRaise(Floats height, Floats best, Floats highest, float enter, float leave) {
  const Floats near = hn::MulAdd(best, hn::Set(lanes, enter), height);
  const Floats far = hn::MulAdd(best, hn::Set(lanes, leave), height);
  return !hn::AllFalse(lanes, hn::Gt(highest, hn::Min(near, far)));
}

HWY_INLINE const float* boundsAt(const Tile& at, const BoxMaxima& maxima, std::size_t vector,
                                 Node corner) {
  const std::ptrdiff_t row = (at.scratch.row[vector] + corner.y) >> maxima.rowShift;
  return maxima.highest.data() + row * at.bake.map.stride + at.scratch.column[vector] + corner.x;
}

/// Leaves those of the active vectors whose horizon the map's highest texel could still raise from
/// some distance on.
HWY_INLINE std::size_t keepActive(Tile& at, std::size_t count, float enter) {
  Index* active = at.scratch.active.data();
  const Floats top = hn::Set(lanes, at.bake.map.maximum);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Index v = active[i];
    active[kept] = v;
    kept += canRaise(at.loweredHeight(v), at.best(v), top, enter, farthest) ? 1 : 0;
  }
  return kept;
}

/// Lists the active vectors whose horizons a bundle could raise.
HWY_NOINLINE std::size_t openBundle(Tile& at, const Stretch& bundle, std::size_t active) {
  TileScratch& scratch = at.scratch;
  std::size_t open = 0;
  for (std::size_t i = 0; i < active; ++i) {
    const Index v = scratch.active[i];
    const Floats highest = hn::LoadU(lanes, boundsAt(at, at.bake.bundles, v, bundle.corner));
    scratch.open[open] = v;
    open += canRaise(at.loweredHeight(v), at.best(v), highest, bundle.enter, bundle.leave) ? 1 : 0;
  }
  return open;
}

/// Lists the groups of a bundle that could raise horizons of its open vectors.
HWY_NOINLINE std::size_t openGroups(Tile& at, std::size_t bundle, std::size_t open) {
  TileScratch& scratch = at.scratch;
  const std::size_t first = bundle * bundleGroups;
  const std::size_t groups = std::min(bundleGroups, at.plan.groups.size() - first);
  const Stretch* stretches = at.plan.groups.data() + first;
  std::array<const float*, bundleGroups> bounds{};
  for (std::size_t k = 0; k < groups; ++k) {
    bounds[k] = at.bake.groups.highest.data() + stretches[k].corner.y * at.bake.map.stride +
                stretches[k].corner.x;
  }
  Visit* visits = roomFor(scratch.visits, open * groups);
  std::size_t count = 0;
  for (std::size_t i = 0; i < open; ++i) {
    const Index v = scratch.open[i];
    const Floats height = at.loweredHeight(v);
    const Floats best = at.best(v);
    const std::uint32_t foreseen = scratch.foreseen[v * at.plan.bundles.size() + bundle];
    for (std::size_t k = 0; k < groups; ++k) {
      const Floats highest = hn::LoadU(lanes, bounds[k] + scratch.offset[v]);
      const bool raises = canRaise(height, best, highest, stretches[k].enter, stretches[k].leave);
      visits[count] = {v, static_cast<Index>(first + k)};
      count += std::uint32_t{raises} & ~(foreseen >> k);
    }
  }
  return count;
}

/// Takes every other group, from near to far, that could raise a horizon.
HWY_INLINE void sweep(Tile& at) {
  constexpr std::size_t bundlesBetween = 4;  // looks at whether anything farther off matters
  TileScratch& scratch = at.scratch;
  std::copy_n(scratch.batch.begin(), scratch.batchCount, scratch.active.begin());
  std::size_t active = scratch.batchCount;
  for (std::size_t b = 0; b < at.plan.bundles.size(); ++b) {
    const Stretch& bundle = at.plan.bundles[b];
    if (b % bundlesBetween == 0) active = keepActive(at, active, bundle.enter);
    if (active == 0) break;
    const std::size_t open = openBundle(at, bundle, active);
    takeGroups(at, openGroups(at, b, open));
  }
}

// --- ends of rays -------------------------------------------------------------------------------

/// The slope at the end of the ray inside a cell, r = D.
HWY_INLINE Floats slopeAtEnd(const Tile& at, std::size_t vector) {
  const AzimuthPlan& plan = at.plan;
  const CellPath& path = plan.lastCell;
  const Floats twist = hn::LoadU(lanes, at.twists(vector) + path.cell);
  if (plan.taps.empty()) {  // the first cell: the slope is linear, without a peak
    const Floats change = hn::Mul(twist, hn::Set(lanes, path.bend * path.length));
    return hn::Sub(load(at.scratch.start.data(), vector), change);
  }
  const float* corner = at.heights(vector) + path.cell;
  const Floats u = hn::Set(lanes, path.u + path.length * static_cast<float>(plan.direction.x));
  const Floats v = hn::Set(lanes, path.v + path.length * static_cast<float>(plan.direction.y));
  const Floats h00 = hn::LoadU(lanes, corner);
  const Floats alongX = hn::Sub(hn::LoadU(lanes, corner + 1), h00);
  const Floats alongY = hn::Sub(hn::LoadU(lanes, corner + at.bake.map.stride), h00);
  const Floats h =
      hn::Add(hn::Add(h00, hn::Mul(u, alongX)), hn::Mul(v, hn::Add(alongY, hn::Mul(u, twist))));
  const Floats inverse = hn::Set(lanes, static_cast<float>(1 / plan.radius));
  return hn::Mul(hn::Sub(h, at.height(vector)), inverse);
}

/// Takes the ends of the rays, and peaks before them, for those vectors whose horizons they could
/// raise.
/// @returns how many these are; `open` lists them
HWY_INLINE std::size_t takeEnds(Tile& at) {
  TileScratch& scratch = at.scratch;
  const AzimuthPlan& plan = at.plan;
  if (!plan.endsInCell) return 0;
  roomForPeaks(scratch, scratch.batchCount);
  std::size_t count = 0;
  for (std::size_t i = 0; i < scratch.batchCount; ++i) {
    const Index v = scratch.batch[i];
    const Floats highest = hn::LoadU(lanes, boundsAt(at, at.bake.groups, v, plan.end.corner));
    if (!canRaise(at.loweredHeight(v), at.best(v), highest, plan.end.enter, plan.end.leave))
      continue;
    const Floats slope = slopeAtEnd(at, v);
    store(slope, scratch.end.data(), v);
    at.raise(v, slope);
    scratch.open[count++] = v;
    if (plan.taps.empty()) continue;
    const Floats before = slopeBefore(at, v, plan.taps.size());
    const Floats least = hn::Sub(at.best(v), hn::Set(lanes, plan.end.tolerance));
    if (mayPeak(at, plan.lastCell, v, before, slope, least)) takePeak(at, plan.lastCell, before, v);
  }
  return count;
}

// --- distances ----------------------------------------------------------------------------------

HWY_INLINE void offerStartsAndEnds(Tile& at, std::size_t ends) {
  TileScratch& scratch = at.scratch;
  const Floats startTolerance = hn::Set(lanes, at.bake.map.tolerance);
  for (std::size_t i = 0; i < scratch.batchCount; ++i) {
    const Index v = scratch.batch[i];
    Floats distance = hn::Set(lanes, never);
    offer(load(scratch.start.data(), v), hn::Zero(lanes), hn::Sub(at.best(v), startTolerance),
          distance);
    store(distance, scratch.distance.data(), v);
  }
  for (std::size_t i = 0; i < ends; ++i) {
    const Index v = scratch.open[i];
    Floats distance = load(scratch.distance.data(), v);
    offer(load(scratch.end.data(), v), hn::Set(lanes, at.plan.end.leave),
          hn::Sub(at.best(v), hn::Set(lanes, at.plan.end.tolerance)), distance);
    store(distance, scratch.distance.data(), v);
  }
}

/// Offers the taps of the groups that attain a horizon, and adds these to the winners.
HWY_NOINLINE void offerTaps(Tile& at) {
  TileScratch& scratch = at.scratch;
  const std::size_t count = findHigh(at, [](const Stretch& group) { return group.tolerance; });
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = scratch.high[i];
    const Visit visit = scratch.kept[index];
    scratch.winners.push_back(visit);
    const Tap* taps = at.plan.taps.data() + visit.group * groupTaps;
    const float* slopes = scratch.slopes.data() + index * groupTaps * hn::Lanes(lanes);
    const Floats best = at.best(visit.vector);
    Floats distance = load(scratch.distance.data(), visit.vector);
    for (std::size_t k = 0; k < groupTaps; ++k) {
      offer(load(slopes, k), hn::Set(lanes, taps[k].distance),
            hn::Sub(best, hn::Set(lanes, taps[k].tolerance)), distance);
    }
    store(distance, scratch.distance.data(), visit.vector);
  }
}

// --- the tile -----------------------------------------------------------------------------------

/// Bakes every `step`-th row from `firstRow` on. What won `rowsBelow` them is looked at first.
void bakeRows(Tile& at, std::size_t firstRow, std::size_t step, std::size_t rowsBelow) {
  openStep(at, firstRow, step);
  takeForeseen(at, rowsBelow);
  sweep(at);
  takePeaks(at);
  const std::size_t ends = takeEnds(at);
  offerStartsAndEnds(at, ends);
  offerTaps(at);
  offerPeaks(at);
}

/// The lowest row first, then in every batch those half way between rows that are done.
void bakeTile(const AzimuthBake& bake, const TexelTile& tile, TileScratch& scratch,
              std::ptrdiff_t stride, float* horizon, float* distance) {
  Tile at = openTile(bake, tile, scratch);
  const std::size_t whole = std::bit_ceil(at.rows);
  bakeRows(at, 0, whole, 0);
  for (std::size_t half = whole / 2; half > 0; half /= 2) bakeRows(at, half, 2 * half, half);
  const auto width = static_cast<std::size_t>(tile.right - tile.left);
  for (std::size_t y = 0; y < at.rows; ++y) {
    const std::size_t from = y * at.across * hn::Lanes(lanes);
    const std::ptrdiff_t to = static_cast<std::ptrdiff_t>(y) * stride;
    std::copy_n(scratch.best.data() + from, width, horizon + to);
    std::copy_n(scratch.distance.data() + from, width, distance + to);
  }
}

const char* instructionSet() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace gnomon::horizon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::horizon {
HWY_EXPORT(bakeTile);
HWY_EXPORT(instructionSet);

void bakeTile(const AzimuthBake& bake, const TexelTile& tile, TileScratch& scratch,
              std::ptrdiff_t stride, float* horizon, float* distance) {
  HWY_DYNAMIC_DISPATCH(bakeTile)(bake, tile, scratch, stride, horizon, distance);
}

const char* bakeInstructionSet() {
  return HWY_DYNAMIC_DISPATCH(instructionSet)();
}

}  // namespace gnomon::horizon
#endif
