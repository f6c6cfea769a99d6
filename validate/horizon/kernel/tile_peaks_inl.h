#include <cmath>
#include <cstddef>
#include <limits>

#include "horizon/kernel/tile_vectors_inl.h"

// Peaks of the slope inside cells: where a cell is bent, a ray may see most between two taps.

// Highway's pattern for headers that are compiled once for each instruction set.
#if defined(GNOMON_RELIEF_TILE_PEAKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RELIEF_TILE_PEAKS_INL_H
#undef GNOMON_RELIEF_TILE_PEAKS_INL_H
#else
#define GNOMON_RELIEF_TILE_PEAKS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace gnomon::horizon {
namespace HWY_NAMESPACE {
namespace {

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
  TileScratch& scratch = at.scratch;
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
  const std::size_t p = scratch.peakCount++;
  scratch.peakVectors[p] = static_cast<Index>(vector);
  store(slope, scratch.peaks.data(), 2 * p);
  store(hn::IfThenElse(inside, hn::Add(enter, x), enter), scratch.peaks.data(), 2 * p + 1);
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
HWY_NOINLINE inline std::size_t findPeakCells(Tile& at, std::size_t high) {
  TileScratch& scratch = at.scratch;
  CellVisit* cells = roomFor(scratch.cells, high * groupTaps);
  std::size_t count = 0;
  for (std::size_t i = 0; i < high; ++i) {
    const std::size_t index = scratch.high[i];
    const Visit visit = scratch.kept[index];
    const std::size_t tap = visit.group * groupTaps;
    const CellPath* paths = at.plan.cells.data() + tap;
    const float* slopes = scratch.slopes.data() + index * groupTaps * hn::Lanes(lanes);
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

HWY_INLINE void roomForPeaks(TileScratch& scratch, std::size_t count) {
  roomFor(scratch.peakVectors, scratch.peakCount + count);
  roomFor(scratch.peaks, 2 * (scratch.peakCount + count) * hn::Lanes(lanes));
}

HWY_INLINE void takePeaks(Tile& at) {
  // Where no cell can hold a peak, no slope is high enough.
  const std::size_t high = findHigh(at, [](const Stretch& group) {
    return group.peakRoom > 0 ? group.tolerance + group.peakRoom : -never;
  });
  const std::size_t count = findPeakCells(at, high);
  roomForPeaks(at.scratch, count);
  for (std::size_t i = 0; i < count; ++i) {
    const CellVisit cell = at.scratch.cells[i];
    takePeak(at, at.plan.cells[cell.tap], slopeBefore(at, cell.vector, cell.tap), cell.vector);
  }
}

HWY_INLINE void offerPeaks(Tile& at) {
  TileScratch& scratch = at.scratch;
  const Floats tolerance = hn::Set(lanes, at.bake.map.tolerance);
  for (std::size_t p = 0; p < scratch.peakCount; ++p) {
    const std::size_t v = scratch.peakVectors[p];
    const Floats slope = load(scratch.peaks.data(), 2 * p);
    const Floats r = load(scratch.peaks.data(), 2 * p + 1);
    const Floats room = hn::Div(tolerance, hn::Max(r, hn::Set(lanes, 1.F)));
    Floats distance = load(scratch.distance.data(), v);
    offer(slope, r, hn::Sub(at.best(v), room), distance);
    store(distance, scratch.distance.data(), v);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace gnomon::horizon
HWY_AFTER_NAMESPACE();
#endif
