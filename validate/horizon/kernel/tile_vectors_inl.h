#include <cstddef>
#include <cstdint>
#include <limits>

#include <hwy/highway.h>

#include "horizon/kernel/tile_kernel.h"

// What every step of the search of a tile is written in: vectors of texels, for the instruction set
// that this is being compiled for.

// Highway's pattern for headers that are compiled once for each instruction set.
#if defined(GNOMON_RELIEF_TILE_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RELIEF_TILE_VECTORS_INL_H
#undef GNOMON_RELIEF_TILE_VECTORS_INL_H
#else
#define GNOMON_RELIEF_TILE_VECTORS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace gnomon::horizon {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using Lanes = hn::ScalableTag<float>;
using Floats = hn::Vec<Lanes>;
using Index = std::uint32_t;
inline constexpr Lanes lanes;

inline constexpr std::size_t groupTaps = AzimuthPlan::groupTaps;
inline constexpr std::size_t bundleGroups = AzimuthPlan::bundleGroups;
static_assert(bundleGroups == 8, "TileScratch::foreseen has a bit for each");
inline constexpr float never = std::numeric_limits<float>::infinity();
inline constexpr float farthest = std::numeric_limits<float>::max();  ///< times 0 it is still 0

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
  TileScratch& scratch;
  std::size_t across, rows;  ///< vectors in a row, rows

  [[nodiscard]] HWY_INLINE const float* heights(std::size_t vector) const {
    return bake.map.heights.data() + scratch.offset[vector];
  }
  [[nodiscard]] HWY_INLINE const float* twists(std::size_t vector) const {
    return bake.map.twists.data() + scratch.offset[vector];
  }
  [[nodiscard]] HWY_INLINE Floats height(std::size_t vector) const {
    return load(scratch.height.data(), vector);
  }
  /// The texel's height less the tolerance, so that rounding does not hide an equal slope.
  [[nodiscard]] HWY_INLINE Floats loweredHeight(std::size_t vector) const {
    return hn::Sub(height(vector), hn::Set(lanes, 2 * bake.map.tolerance));
  }
  [[nodiscard]] HWY_INLINE Floats best(std::size_t vector) const {
    return load(scratch.best.data(), vector);
  }
  HWY_INLINE void raise(std::size_t vector, Floats slope) {
    store(hn::Max(best(vector), slope), scratch.best.data(), vector);
  }
};

/// The slope at a tap.
HWY_INLINE Floats slopeAt(const float* heights, Floats height, const Tap& tap) {
  const Floats from = hn::LoadU(lanes, heights + tap.from);
  const Floats to = hn::LoadU(lanes, heights + tap.to);
  const Floats h = hn::Add(from, hn::Mul(hn::Set(lanes, tap.share), hn::Sub(to, from)));
  return hn::Mul(hn::Sub(h, height), hn::Set(lanes, tap.inverseDistance));
}

/// Indices of the kept groups that come within some room of a horizon.
template <typename Room>
HWY_INLINE std::size_t findHigh(Tile& at, const Room& roomOf) {
  TileScratch& scratch = at.scratch;
  Index* high = roomFor(scratch.high, scratch.keptCount);
  std::size_t count = 0;
  for (std::size_t i = 0; i < scratch.keptCount; ++i) {
    const Visit visit = scratch.kept[i];
    const Floats room = hn::Set(lanes, roomOf(at.plan.groups[visit.group]));
    const Floats least = hn::Sub(at.best(visit.vector), room);
    high[count] = static_cast<Index>(i);
    count += hn::AllFalse(lanes, hn::Ge(load(scratch.highest.data(), i), least)) ? 0 : 1;
  }
  return count;
}

/// Lets `distance` be r where a slope there equals the horizon and nothing nearer does.
HWY_INLINE void offer(Floats slope, Floats r, Floats least, Floats& distance) {
  distance = hn::IfThenElse(hn::Ge(slope, least), hn::Min(distance, r), distance);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace gnomon::horizon
HWY_AFTER_NAMESPACE();
#endif
