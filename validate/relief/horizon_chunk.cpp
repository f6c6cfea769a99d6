#include "relief/horizon_chunk.h"

#include <cmath>
#include <cstring>

#include "relief/horizon_chunk_peaks.h"

// The baker is written in the compiler's vectors and compiled once for each of several widths; the
// processor that runs it decides. Every variant does the same operations on each texel.
#if defined(__x86_64__) && !defined(GNOMON_SANITIZED)
#define GNOMON_WIDE_VECTORS 1
#else
#define GNOMON_WIDE_VECTORS 0
#endif

// What is compiled for several widths must become part of the function that names the processor.
#define GNOMON_INLINE inline __attribute__((always_inline))

namespace gnomon {
namespace {

// --- vectors of `lanes` floats ------------------------------------------------------------------
// They are passed by reference only: how they are passed by value depends on the processor.

template <int lanes>
struct Vector {
  using Floats __attribute__((vector_size(lanes * sizeof(float)))) = float;
  using Ints __attribute__((vector_size(lanes * sizeof(float)))) = std::int32_t;
};

template <typename V, typename T>
GNOMON_INLINE void load(V& vector, const T* from) {
  std::memcpy(&vector, from, sizeof vector);
}

template <typename V, typename T>
GNOMON_INLINE void store(const V& vector, T* to) {
  std::memcpy(to, &vector, sizeof vector);
}

/// Whether any of these is over 0.
template <int lanes>
GNOMON_INLINE bool anyPositive(const typename Vector<lanes>::Floats& values) {
  using Ints = typename Vector<lanes>::Ints;
  const Ints positive = values > 0 ? Ints{} + 1 : Ints{};
  // Narrowed first: few words are left to look at.
  using Bytes __attribute__((vector_size(lanes))) = std::int8_t;
  const Bytes bytes = __builtin_convertvector(positive, Bytes);
  std::array<std::uint32_t, lanes / 4> words;
  std::memcpy(words.data(), &bytes, sizeof bytes);
  std::uint32_t all = 0;
  for (const std::uint32_t word : words) all |= word;
  return all != 0;
}

// --- a vector of texels -------------------------------------------------------------------------

/// What a vector of texels holds while it meets a group.
template <int lanes>
struct Lanes {
  using Floats = typename Vector<lanes>::Floats;
  Floats h0, slope;
  const float* heights;
  const float* twists;
};

template <int lanes>
GNOMON_INLINE void loadLanes(const HorizonChunk& chunk, std::size_t first, Lanes<lanes>& at) {
  at.heights = chunk.heights + first;
  at.twists = chunk.twists + first;
  load(at.h0, at.heights);
  load(at.slope, chunk.slope.data() + first);
}

/// Whether a height `highest` between two distances could raise the horizon of any texel.
template <int lanes>
GNOMON_INLINE bool canRaise(const Lanes<lanes>& at, float highest, float inverseNear,
                            float inverseFar) {
  using Floats = typename Vector<lanes>::Floats;
  const Floats rise = highest - at.h0;
  const Floats near = rise * inverseNear;
  const Floats far = rise * inverseFar;
  const Floats excess = (near > far ? near : far) - at.slope;
  return anyPositive<lanes>(excess);
}

template <int lanes>
GNOMON_INLINE void slopeAt(const Lanes<lanes>& at, const Tap& tap,
                           typename Vector<lanes>::Floats& slope) {
  typename Vector<lanes>::Floats from, to;
  load(from, at.heights + tap.from);
  load(to, at.heights + tap.to);
  slope = ((from + tap.share * (to - from)) - at.h0) * tap.inverseDistance;
}

/// Over 0 where a peak inside a cell may exceed `best`, given the slopes at the cell's two ends: a
/// quarter of the bulge above the higher one must reach it, and they must differ by less than the
/// bulge.
template <int lanes>
GNOMON_INLINE void peakChance(const typename Vector<lanes>::Floats& before,
                              const typename Vector<lanes>::Floats& after,
                              const typename Vector<lanes>::Floats& best,
                              const typename Vector<lanes>::Floats& quarterBulge,
                              typename Vector<lanes>::Floats& chance) {
  using Floats = typename Vector<lanes>::Floats;
  const Floats change = after - before;
  const Floats size = change > 0 ? change : -change;
  const Floats excess = (change > 0 ? after : before) + quarterBulge - best;
  const Floats room = 4 * quarterBulge - size;
  // The lesser of the two, not two comparisons: gcc 12 combines those one lane at a time.
  chance = excess < room ? excess : room;
}

/// Takes every tap of a group in order and marks the cells whose inside may hold a slope that is
/// greater still.
template <int lanes>
GNOMON_INLINE void takeGroup(const AzimuthPlan& plan, const TapGroup& group, std::size_t first,
                             const Lanes<lanes>& at, HorizonChunk& chunk) {
  using Floats = typename Vector<lanes>::Floats;
  using Ints = typename Vector<lanes>::Ints;
  const Ints none{};
  Ints peaks = none;
  Ints bit = none + 1;
  Floats candidate, chance, distance, threshold, twist;
  Floats slope = at.slope;
  load(distance, chunk.distance.data() + first);
  load(threshold, chunk.threshold.data() + first);
  Floats previous = at.slope;
  if (group.begin > 0) slopeAt<lanes>(at, plan.taps[group.begin - 1], previous);
  for (std::size_t k = group.begin; k < group.end; ++k) {
    const Tap& tap = plan.taps[k];
    slopeAt<lanes>(at, tap, candidate);
    load(twist, at.twists + tap.cell);
    const Ints greater = candidate > threshold;
    slope = greater ? candidate : slope;
    distance = greater ? tap.distance - Floats{} : distance;
    threshold = greater ? candidate + tap.tolerance : threshold;
    const Floats quarterBulge = twist * tap.quarterBulge;
    peakChance<lanes>(previous, candidate, slope, quarterBulge, chance);
    peaks |= chance > 0 ? bit : none;
    bit += bit;
    previous = candidate;
  }
  store(slope, chunk.slope.data() + first);
  store(distance, chunk.distance.data() + first);
  store(threshold, chunk.threshold.data() + first);
  store(peaks, chunk.peaks.data() + first);
}

// --- the chunk ----------------------------------------------------------------------------------

/// The limit r → 0⁺: the directional derivative.
GNOMON_INLINE void startChunk(const PaddedMap& map, Vec2 direction, HorizonChunk& chunk) {
  const std::ptrdiff_t alongX = direction.x < 0 ? -1 : 1;
  const std::ptrdiff_t alongY = direction.y < 0 ? -map.stride : map.stride;
  const auto ex = static_cast<float>(std::abs(direction.x));
  const auto ey = static_cast<float>(std::abs(direction.y));
  const auto tolerance = static_cast<float>(map.tolerance);
  for (std::size_t i = 0; i < chunkWidth; ++i) {
    const float* h = chunk.heights + i;
    chunk.slope[i] = ex * (h[alongX] - h[0]) + ey * (h[alongY] - h[0]);
    chunk.distance[i] = 0;
    chunk.threshold[i] = chunk.slope[i] + tolerance;
  }
}

/// A bound on what the group touches from any texel of the chunk.
GNOMON_INLINE float highestTouched(const PaddedMap& map, const HorizonChunk& chunk,
                                   const TapGroup& group) {
  const TexelBox& box = group.touched;
  return highestIn(map, {chunk.column + box.left, chunk.row + box.bottom,
                         chunk.column + chunkWidth - 1 + box.right, chunk.row + box.top});
}

/// One group for a whole chunk. False if nothing beyond it can raise any horizon.
template <int lanes>
GNOMON_INLINE bool meetGroup(const PaddedMap& map, const AzimuthPlan& plan, const TapGroup& group,
                             HorizonChunk& chunk) {
  const float highest = highestTouched(map, chunk, group);
  bool open = false;
  for (std::size_t first = 0; first < chunkWidth; first += lanes) {
    Lanes<lanes> at;
    loadLanes<lanes>(chunk, first, at);
    if (canRaise<lanes>(at, highest, group.inverseEnter, group.inverseLeave)) {
      open = true;
      takeGroup<lanes>(plan, group, first, at, chunk);
      takeMarkedPeaks(map, plan, group, first, first + lanes, chunk);
    } else {
      open = open || canRaise<lanes>(at, map.maximum, group.inverseLeave, 0);
    }
  }
  return open;
}

/// The cell in which the ray ends, for those texels whose horizon it could raise.
template <int lanes>
GNOMON_INLINE void meetLastCell(const PaddedMap& map, const AzimuthPlan& plan,
                                HorizonChunk& chunk) {
  const TapGroup& cell = plan.lastCell;
  const float highest = highestTouched(map, chunk, cell);
  for (std::size_t first = 0; first < chunkWidth; first += lanes) {
    Lanes<lanes> at;
    loadLanes<lanes>(chunk, first, at);
    if (canRaise<lanes>(at, highest, cell.inverseEnter, cell.inverseLeave)) {
      takeLastCell(map, plan, first, first + lanes, chunk);
    }
  }
}

template <int lanes>
GNOMON_INLINE void bakeChunk(const PaddedMap& map, const AzimuthPlan& plan, HorizonChunk& chunk) {
  startChunk(map, plan.ray.direction, chunk);
  for (const TapGroup& group : plan.groups) {
    if (!meetGroup<lanes>(map, plan, group, chunk)) return;
  }
  if (plan.ray.lastEnter < plan.ray.radius) meetLastCell<lanes>(map, plan, chunk);
}

// --- the processors -----------------------------------------------------------------------------

void bakeNarrow(const PaddedMap& map, const AzimuthPlan& plan, HorizonChunk& chunk) {
  bakeChunk<4>(map, plan, chunk);
}

#if GNOMON_WIDE_VECTORS
__attribute__((target("avx2"))) void bakeAvx2(const PaddedMap& map, const AzimuthPlan& plan,
                                              HorizonChunk& chunk) {
  bakeChunk<8>(map, plan, chunk);
}

__attribute__((target("avx512f,avx512dq,avx512vl,avx512bw"))) void bakeAvx512(
    const PaddedMap& map, const AzimuthPlan& plan, HorizonChunk& chunk) {
  bakeChunk<16>(map, plan, chunk);
}
#endif

}  // namespace

HorizonChunk chunkAt(const PaddedMap& map, std::ptrdiff_t column, std::ptrdiff_t row) {
  const std::ptrdiff_t origin = row * map.stride + column;
  HorizonChunk chunk;
  chunk.column = column;
  chunk.row = row;
  chunk.heights = map.heights.data() + origin;
  chunk.twists = map.twists.data() + origin;
  return chunk;
}

ChunkBaker chunkBaker() {
#if GNOMON_WIDE_VECTORS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw")) {
    return bakeAvx512;
  }
  if (__builtin_cpu_supports("avx2")) return bakeAvx2;
#endif
  return bakeNarrow;
}

}  // namespace gnomon
