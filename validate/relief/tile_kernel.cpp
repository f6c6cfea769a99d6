#include "relief/tile_kernel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

// This file is compiled once for each instruction set that gives other code here; the processor
// that runs it decides. SSSE3 has no wider vectors than SSE4, which all such processors but the
// oldest have, and AVX3_DL adds to AVX-512 only instructions that are not used here.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "relief/tile_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace gnomon {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using Lanes = hn::ScalableTag<float>;
using Floats = hn::Vec<Lanes>;
using Index = std::uint32_t;
constexpr Lanes lanes;

constexpr std::size_t groupTaps = AzimuthPlan::groupTaps;
constexpr std::size_t bundleGroups = AzimuthPlan::bundleGroups;
static_assert(bundleGroups == 8, "TileNotes::foreseen has a bit for each");
constexpr float never = std::numeric_limits<float>::infinity();
constexpr float farthest = std::numeric_limits<float>::max();  ///< times 0 it is still 0

/// Lengthens a list to some count where it is shorter.
template <typename T>
HWY_INLINE T* roomFor(RawVector<T>& list, std::size_t count) {
  if (list.size() < count) list.resize(count);
  return list.data();
}

HWY_INLINE Floats load(const float* values, std::size_t vector) {
  return hn::Load(lanes, values + vector * hn::Lanes(lanes));
}

HWY_INLINE void store(Floats value, float* values, std::size_t vector) {
  hn::Store(value, lanes, values + vector * hn::Lanes(lanes));
}

/// A tile of one azimuth, its texels in vectors, row by row.
struct Tile {
  const AzimuthBake& bake;
  const AzimuthPlan& plan;
  TileNotes& notes;
  std::size_t across, rows;  ///< vectors in a row, rows

  [[nodiscard]] HWY_INLINE const float* heights(std::size_t vector) const {
    return bake.map.heights.data() + notes.offset[vector];
  }
  [[nodiscard]] HWY_INLINE const float* twists(std::size_t vector) const {
    return bake.map.twists.data() + notes.offset[vector];
  }
  [[nodiscard]] HWY_INLINE Floats height(std::size_t vector) const {
    return load(notes.height.data(), vector);
  }
  /// Height less what keeps roundings from hiding an equal.
  [[nodiscard]] HWY_INLINE Floats reach(std::size_t vector) const {
    return hn::Sub(height(vector), hn::Set(lanes, 2 * bake.map.tolerance));
  }
  [[nodiscard]] HWY_INLINE Floats best(std::size_t vector) const {
    return load(notes.best.data(), vector);
  }
  HWY_INLINE void raise(std::size_t vector, Floats slope) {
    store(hn::Max(best(vector), slope), notes.best.data(), vector);
  }
};

Tile openTile(const AzimuthBake& bake, const TexelTile& tile, TileNotes& notes) {
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
      notes.row[v] = static_cast<std::int32_t>(row);
      notes.column[v] = static_cast<std::int32_t>(column);
      notes.offset[v] = row * map.stride + column;
    }
  }
  notes.winners.clear();
  notes.foreseen.assign(v * bake.plan.bundles.size(), 0);
  return {bake, bake.plan, notes, across, static_cast<std::size_t>(tile.top - tile.bottom)};
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

/// Vectors of a turn with the slopes that they start from.
void openTurn(Tile& at, std::size_t firstRow, std::size_t step) {
  TileNotes& notes = at.notes;
  notes.turnCount = 0;
  for (std::size_t y = firstRow; y < at.rows; y += step) {
    for (std::size_t x = 0; x < at.across; ++x) {
      const std::size_t v = y * at.across + x;
      const float* heights = at.heights(v);
      const Floats height = hn::LoadU(lanes, heights);
      const Floats start = derivative(at, heights, height);
      store(height, notes.height.data(), v);
      store(start, notes.start.data(), v);
      store(start, notes.best.data(), v);
      notes.turn[notes.turnCount++] = static_cast<Index>(v);
    }
  }
  notes.keptCount = 0;
  notes.peakCount = 0;
}

// --- groups of taps -----------------------------------------------------------------------------

HWY_INLINE Floats slopeAt(const float* heights, Floats height, const Tap& tap) {
  const Floats from = hn::LoadU(lanes, heights + tap.from);
  const Floats to = hn::LoadU(lanes, heights + tap.to);
  const Floats h = hn::Add(from, hn::Mul(hn::Set(lanes, tap.share), hn::Sub(to, from)));
  return hn::Mul(hn::Sub(h, height), hn::Set(lanes, tap.inverseDistance));
}

/// Finds the slopes of groups, and keeps those that may attain a horizon at a tap or beside one.
HWY_NOINLINE void takeGroups(Tile& at, std::size_t count) {
  TileNotes& notes = at.notes;
  const std::size_t vector = hn::Lanes(lanes);
  const Visit* visits = notes.visits.data();
  Visit* kept = roomFor(notes.kept, notes.keptCount + count);
  float* allSlopes = roomFor(notes.slopes, (notes.keptCount + count) * groupTaps * vector);
  float* allHighest = roomFor(notes.highest, (notes.keptCount + count) * vector);
  std::size_t keptCount = notes.keptCount;
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
    store(best, notes.best.data(), visit.vector);
    store(highest, allHighest, keptCount);
    kept[keptCount] = visit;
    const Floats least = hn::Sub(best, hn::Set(lanes, group.tolerance + group.peakRoom));
    keptCount += hn::AllFalse(lanes, hn::Ge(highest, least)) ? 0 : 1;
  }
  notes.keptCount = keptCount;
}

/// Takes the groups that won in rows at some distance below, so that most others need no look.
HWY_INLINE void takeForeseen(Tile& at, std::size_t rowsBelow) {
  TileNotes& notes = at.notes;
  Visit* visits = roomFor(notes.visits, notes.winners.size());
  std::size_t count = 0;
  for (const Visit& winner : notes.winners) {
    const std::size_t v = winner.vector + rowsBelow * at.across;
    if (v >= at.rows * at.across) continue;
    visits[count++] = {static_cast<Index>(v), winner.group};
    notes.foreseen[v * at.plan.bundles.size() + winner.group / bundleGroups] |=
        static_cast<std::uint8_t>(1U << (winner.group % bundleGroups));
  }
  takeGroups(at, count);
}

/// Whether a height up to `highest` between two distances could equal or exceed any horizon.
HWY_INLINE bool canRaise(Floats reach, Floats best, Floats highest, float enter, float leave) {
  const Floats near = hn::MulAdd(best, hn::Set(lanes, enter), reach);
  const Floats far = hn::MulAdd(best, hn::Set(lanes, leave), reach);
  return !hn::AllFalse(lanes, hn::Gt(highest, hn::Min(near, far)));
}

HWY_INLINE const float* boundsAt(const Tile& at, const BoxMaxima& maxima, std::size_t vector,
                                 Node corner) {
  const std::ptrdiff_t row = (at.notes.row[vector] + corner.y) >> maxima.rowShift;
  return maxima.highest.data() + row * at.bake.map.stride + at.notes.column[vector] + corner.x;
}

/// Leaves those of the active vectors whose horizon the map's highest texel could still raise from
/// some distance on.
HWY_INLINE std::size_t keepActive(Tile& at, std::size_t count, float enter) {
  Index* active = at.notes.active.data();
  const Floats top = hn::Set(lanes, at.bake.map.maximum);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Index v = active[i];
    active[kept] = v;
    kept += canRaise(at.reach(v), at.best(v), top, enter, farthest) ? 1 : 0;
  }
  return kept;
}

/// Lists the active vectors whose horizons a bundle could raise.
HWY_NOINLINE std::size_t openBundle(Tile& at, const Stretch& bundle, std::size_t active) {
  TileNotes& notes = at.notes;
  std::size_t open = 0;
  for (std::size_t i = 0; i < active; ++i) {
    const Index v = notes.active[i];
    const Floats highest = hn::LoadU(lanes, boundsAt(at, at.bake.bundles, v, bundle.corner));
    notes.open[open] = v;
    open += canRaise(at.reach(v), at.best(v), highest, bundle.enter, bundle.leave) ? 1 : 0;
  }
  return open;
}

/// Lists the groups of a bundle that could raise horizons of its open vectors.
HWY_NOINLINE std::size_t openGroups(Tile& at, std::size_t bundle, std::size_t open) {
  TileNotes& notes = at.notes;
  const std::size_t first = bundle * bundleGroups;
  const std::size_t groups = std::min(bundleGroups, at.plan.groups.size() - first);
  const Stretch* stretches = at.plan.groups.data() + first;
  std::array<const float*, bundleGroups> bounds{};
  for (std::size_t k = 0; k < groups; ++k) {
    bounds[k] = at.bake.groups.highest.data() + stretches[k].corner.y * at.bake.map.stride +
                stretches[k].corner.x;
  }
  Visit* visits = roomFor(notes.visits, open * groups);
  std::size_t count = 0;
  for (std::size_t i = 0; i < open; ++i) {
    const Index v = notes.open[i];
    const Floats reach = at.reach(v);
    const Floats best = at.best(v);
    const std::uint32_t foreseen = notes.foreseen[v * at.plan.bundles.size() + bundle];
    for (std::size_t k = 0; k < groups; ++k) {
      const Floats highest = hn::LoadU(lanes, bounds[k] + notes.offset[v]);
      const bool raises = canRaise(reach, best, highest, stretches[k].enter, stretches[k].leave);
      visits[count] = {v, static_cast<Index>(first + k)};
      count += std::uint32_t{raises} & ~(foreseen >> k);
    }
  }
  return count;
}

/// Takes every other group, from near to far, that could raise a horizon.
HWY_INLINE void sweep(Tile& at) {
  constexpr std::size_t bundlesBetween = 4;  // looks at whether anything farther off matters
  TileNotes& notes = at.notes;
  std::copy_n(notes.turn.begin(), notes.turnCount, notes.active.begin());
  std::size_t active = notes.turnCount;
  for (std::size_t b = 0; b < at.plan.bundles.size(); ++b) {
    const Stretch& bundle = at.plan.bundles[b];
    if (b % bundlesBetween == 0) active = keepActive(at, active, bundle.enter);
    if (active == 0) break;
    const std::size_t open = openBundle(at, bundle, active);
    takeGroups(at, openGroups(at, b, open));
  }
}

/// Indices of the kept groups that come within some room of a horizon.
template <typename Room>
HWY_INLINE std::size_t findHigh(Tile& at, const Room& roomOf) {
  TileNotes& notes = at.notes;
  Index* high = roomFor(notes.high, notes.keptCount);
  std::size_t count = 0;
  for (std::size_t i = 0; i < notes.keptCount; ++i) {
    const Visit visit = notes.kept[i];
    const Floats room = hn::Set(lanes, roomOf(at.plan.groups[visit.group]));
    const Floats least = hn::Sub(at.best(visit.vector), room);
    high[count] = static_cast<Index>(i);
    count += hn::AllFalse(lanes, hn::Ge(load(notes.highest.data(), i), least)) ? 0 : 1;
  }
  return count;
}

// --- peaks --------------------------------------------------------------------------------------

/// The slope where the ray enters the cell before a tap; at the start that of the tap itself, for
/// the first cell has no peak.
HWY_INLINE Floats slopeBefore(const Tile& at, std::size_t vector, std::size_t tap) {
  const Tap& before = at.plan.taps[tap > 0 ? tap - 1 : 0];
  return slopeAt(at.heights(vector), at.height(vector), before);
}

/// The peak of the slope inside a cell that is entered at r₀ with slope s₀: with a the derivative
/// of the height there, C = -c its bend and w = a - s₀, x = r - r₀ solves c x² + 2 c r₀ x = r₀ w,
/// and the slope at it is s₀ + c x² / r₀.
HWY_INLINE void takePeak(Tile& at, const CellPath& path, Floats before, std::size_t vector) {
  TileNotes& notes = at.notes;
  const float* corner = at.heights(vector) + path.cell;
  const Vec2 e = at.plan.direction;
  const Floats h00 = hn::LoadU(lanes, corner);
  const Floats alongX = hn::Sub(hn::LoadU(lanes, corner + 1), h00);
  const Floats alongY = hn::Sub(hn::LoadU(lanes, corner + at.bake.map.stride), h00);
  const Floats twist = hn::LoadU(lanes, at.twists(vector) + path.cell);
  const Floats gradientX = hn::Add(alongX, hn::Mul(twist, hn::Set(lanes, path.v)));
  const Floats gradientY = hn::Add(alongY, hn::Mul(twist, hn::Set(lanes, path.u)));
  const Floats gradient = hn::Add(hn::Mul(gradientX, hn::Set(lanes, static_cast<float>(e.x))),
                                  hn::Mul(gradientY, hn::Set(lanes, static_cast<float>(e.y))));
  const Floats climb = hn::Sub(gradient, before);
  const Floats bend = hn::Mul(twist, hn::Set(lanes, path.bend));
  const Floats enter = hn::Set(lanes, path.enter);
  const Floats fall = hn::Mul(bend, enter);
  const Floats x =
      hn::Div(hn::Mul(enter, climb), hn::Add(fall, hn::Sqrt(hn::Mul(fall, hn::Add(fall, climb)))));
  const Floats zero = hn::Zero(lanes);
  const auto inside = hn::And(hn::And(hn::Gt(bend, zero), hn::Gt(climb, zero)),
                              hn::Lt(x, hn::Set(lanes, path.length)));
  const Floats peak =
      hn::Add(before, hn::Mul(hn::Mul(bend, hn::Mul(x, x)), hn::Set(lanes, path.inverseEnter)));
  const Floats slope = hn::IfThenElse(inside, peak, hn::Set(lanes, -never));
  const std::size_t p = notes.peakCount++;
  notes.peakVectors[p] = static_cast<Index>(vector);
  store(slope, notes.peaks.data(), 2 * p);
  store(hn::IfThenElse(inside, hn::Add(enter, x), enter), notes.peaks.data(), 2 * p + 1);
  at.raise(vector, slope);
}

/// Whether a cell may hold a peak that equals or exceeds a horizon, given the slopes at its ends: a
/// quarter of the bulge above the higher one must reach it, and they must differ by less than the
/// bulge.
HWY_INLINE bool mayPeak(const Tile& at, const CellPath& path, std::size_t vector, Floats before,
                        Floats after, Floats least) {
  const Floats twist = hn::LoadU(lanes, at.twists(vector) + path.cell);
  const Floats bulge = hn::Mul(twist, hn::Set(lanes, path.quarterBulge));
  const auto reaches = hn::Ge(hn::Add(hn::Max(before, after), bulge), least);
  const Floats bend = hn::Mul(bulge, hn::Set(lanes, 4.F));
  return !hn::AllFalse(lanes, hn::And(reaches, hn::Gt(bend, hn::Abs(hn::Sub(after, before)))));
}

/// Lists the cells of high groups that may hold a peak.
HWY_NOINLINE std::size_t findPeakCells(Tile& at, std::size_t high) {
  TileNotes& notes = at.notes;
  CellVisit* cells = roomFor(notes.cells, high * groupTaps);
  std::size_t count = 0;
  for (std::size_t i = 0; i < high; ++i) {
    const std::size_t index = notes.high[i];
    const Visit visit = notes.kept[index];
    const std::size_t tap = visit.group * groupTaps;
    const CellPath* paths = at.plan.cells.data() + tap;
    const float* slopes = notes.slopes.data() + index * groupTaps * hn::Lanes(lanes);
    const Floats tolerance = hn::Set(lanes, at.plan.groups[visit.group].tolerance);
    const Floats least = hn::Sub(at.best(visit.vector), tolerance);
    Floats before = slopeBefore(at, visit.vector, tap);
    for (std::size_t k = 0; k < groupTaps; ++k) {
      const Floats after = load(slopes, k);
      cells[count] = {visit.vector, static_cast<Index>(tap + k)};
      count += mayPeak(at, paths[k], visit.vector, before, after, least) ? 1 : 0;
      before = after;
    }
  }
  return count;
}

void roomForPeaks(TileNotes& notes, std::size_t count) {
  roomFor(notes.peakVectors, notes.peakCount + count);
  roomFor(notes.peaks, 2 * (notes.peakCount + count) * hn::Lanes(lanes));
}

HWY_INLINE void takePeaks(Tile& at) {
  // Where no cell can hold a peak, no slope is high enough.
  const std::size_t high = findHigh(at, [](const Stretch& group) {
    return group.peakRoom > 0 ? group.tolerance + group.peakRoom : -never;
  });
  const std::size_t count = findPeakCells(at, high);
  roomForPeaks(at.notes, count);
  for (std::size_t i = 0; i < count; ++i) {
    const CellVisit cell = at.notes.cells[i];
    takePeak(at, at.plan.cells[cell.tap], slopeBefore(at, cell.vector, cell.tap), cell.vector);
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
    return hn::Sub(load(at.notes.start.data(), vector), change);
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
  TileNotes& notes = at.notes;
  const AzimuthPlan& plan = at.plan;
  if (!plan.endsInCell) return 0;
  roomForPeaks(notes, notes.turnCount);
  std::size_t count = 0;
  for (std::size_t i = 0; i < notes.turnCount; ++i) {
    const Index v = notes.turn[i];
    const Floats highest = hn::LoadU(lanes, boundsAt(at, at.bake.groups, v, plan.end.corner));
    if (!canRaise(at.reach(v), at.best(v), highest, plan.end.enter, plan.end.leave)) continue;
    const Floats slope = slopeAtEnd(at, v);
    store(slope, notes.end.data(), v);
    at.raise(v, slope);
    notes.open[count++] = v;
    if (plan.taps.empty()) continue;
    const Floats before = slopeBefore(at, v, plan.taps.size());
    const Floats least = hn::Sub(at.best(v), hn::Set(lanes, plan.end.tolerance));
    if (mayPeak(at, plan.lastCell, v, before, slope, least)) takePeak(at, plan.lastCell, before, v);
  }
  return count;
}

// --- distances ----------------------------------------------------------------------------------

/// Lets `distance` be r where a slope there equals the horizon and nothing nearer does.
HWY_INLINE void offer(Floats slope, Floats r, Floats least, Floats& distance) {
  distance = hn::IfThenElse(hn::Ge(slope, least), hn::Min(distance, r), distance);
}

HWY_INLINE void offerStartsAndEnds(Tile& at, std::size_t ends) {
  TileNotes& notes = at.notes;
  const Floats startTolerance = hn::Set(lanes, at.bake.map.tolerance);
  for (std::size_t i = 0; i < notes.turnCount; ++i) {
    const Index v = notes.turn[i];
    Floats distance = hn::Set(lanes, never);
    offer(load(notes.start.data(), v), hn::Zero(lanes), hn::Sub(at.best(v), startTolerance),
          distance);
    store(distance, notes.distance.data(), v);
  }
  for (std::size_t i = 0; i < ends; ++i) {
    const Index v = notes.open[i];
    Floats distance = load(notes.distance.data(), v);
    offer(load(notes.end.data(), v), hn::Set(lanes, at.plan.end.leave),
          hn::Sub(at.best(v), hn::Set(lanes, at.plan.end.tolerance)), distance);
    store(distance, notes.distance.data(), v);
  }
}

/// Offers the taps of the groups that attain a horizon, and adds these to the winners.
HWY_NOINLINE void offerTaps(Tile& at) {
  TileNotes& notes = at.notes;
  const std::size_t count = findHigh(at, [](const Stretch& group) { return group.tolerance; });
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = notes.high[i];
    const Visit visit = notes.kept[index];
    notes.winners.push_back(visit);
    const Tap* taps = at.plan.taps.data() + visit.group * groupTaps;
    const float* slopes = notes.slopes.data() + index * groupTaps * hn::Lanes(lanes);
    const Floats best = at.best(visit.vector);
    Floats distance = load(notes.distance.data(), visit.vector);
    for (std::size_t k = 0; k < groupTaps; ++k) {
      offer(load(slopes, k), hn::Set(lanes, taps[k].distance),
            hn::Sub(best, hn::Set(lanes, taps[k].tolerance)), distance);
    }
    store(distance, notes.distance.data(), visit.vector);
  }
}

HWY_INLINE void offerPeaks(Tile& at) {
  TileNotes& notes = at.notes;
  const Floats tolerance = hn::Set(lanes, at.bake.map.tolerance);
  for (std::size_t p = 0; p < notes.peakCount; ++p) {
    const std::size_t v = notes.peakVectors[p];
    const Floats slope = load(notes.peaks.data(), 2 * p);
    const Floats r = load(notes.peaks.data(), 2 * p + 1);
    const Floats room = hn::Div(tolerance, hn::Max(r, hn::Set(lanes, 1.F)));
    Floats distance = load(notes.distance.data(), v);
    offer(slope, r, hn::Sub(at.best(v), room), distance);
    store(distance, notes.distance.data(), v);
  }
}

// --- the tile -----------------------------------------------------------------------------------

/// Bakes every `step`-th row from `firstRow` on. What won `rowsBelow` them is looked at first.
void bakeRows(Tile& at, std::size_t firstRow, std::size_t step, std::size_t rowsBelow) {
  openTurn(at, firstRow, step);
  takeForeseen(at, rowsBelow);
  sweep(at);
  takePeaks(at);
  const std::size_t ends = takeEnds(at);
  offerStartsAndEnds(at, ends);
  offerTaps(at);
  offerPeaks(at);
}

/// The lowest row first, then in every turn those half way between rows that are done.
void bakeTile(const AzimuthBake& bake, const TexelTile& tile, TileNotes& notes,
              std::ptrdiff_t stride, float* horizon, float* distance) {
  Tile at = openTile(bake, tile, notes);
  const std::size_t whole = std::bit_ceil(at.rows);
  bakeRows(at, 0, whole, 0);
  for (std::size_t half = whole / 2; half > 0; half /= 2) bakeRows(at, half, 2 * half, half);
  const auto width = static_cast<std::size_t>(tile.right - tile.left);
  for (std::size_t y = 0; y < at.rows; ++y) {
    const std::size_t from = y * at.across * hn::Lanes(lanes);
    const std::ptrdiff_t to = static_cast<std::ptrdiff_t>(y) * stride;
    std::copy_n(notes.best.data() + from, width, horizon + to);
    std::copy_n(notes.distance.data() + from, width, distance + to);
  }
}

const char* instructionSet() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace gnomon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon {
HWY_EXPORT(bakeTile);
HWY_EXPORT(instructionSet);

void bakeTile(const AzimuthBake& bake, const TexelTile& tile, TileNotes& notes,
              std::ptrdiff_t stride, float* horizon, float* distance) {
  HWY_DYNAMIC_DISPATCH(bakeTile)(bake, tile, notes, stride, horizon, distance);
}

const char* bakeInstructionSet() {
  return HWY_DYNAMIC_DISPATCH(instructionSet)();
}

}  // namespace gnomon
#endif
