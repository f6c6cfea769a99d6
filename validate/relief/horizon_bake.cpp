#include "relief/horizon_bake.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <mutex>
#include <vector>

#include "common/error.h"
#include "common/memory.h"
#include "common/parallel.h"
#include "relief/ray_crossings.h"

// The inner loop is written in the compiler's vectors and compiled once for each of these widths;
// the processor that runs it decides. Every variant does the same operations on each texel.
#if defined(__x86_64__) && !defined(GNOMON_SANITIZED)
#define GNOMON_WIDE_VECTORS 1
#else
#define GNOMON_WIDE_VECTORS 0
#endif

namespace gnomon {
namespace {

constexpr int chunkWidth = 64;  ///< texels of a row that are baked together
constexpr int tileRows = 32;    ///< rows of a chunk that a thread takes at once
constexpr int groupSize = 16;   ///< crossings that are skipped or taken together
constexpr int blockShift = 4;   ///< log2 of the side of the blocks whose maxima are kept

/// The map with a margin on all sides that the wrap rule filled, so that no ray needs it any more.
/// Heights are relative to the middle of the map's range: floats are finest there.
struct PaddedMap {
  std::ptrdiff_t stride = 0;
  std::ptrdiff_t rows = 0;
  std::ptrdiff_t margin = 0;
  std::vector<float> heights;
  /// h00 - h10 - h01 + h11 of the cell right of and above each texel: what bends a ray's profile.
  std::vector<float> twists;
  std::ptrdiff_t blockStride = 0;
  std::vector<float> blockMaxima;  ///< of blocks of 2^blockShift texels squared
  float maximum = 0;
  float range = 0;  ///< highest minus lowest
};

/// A crossing as the inner loop wants it: offsets into the padded map and floats.
struct Tap {
  std::ptrdiff_t from, to, cell;
  float share;
  float distance;
  float inverseDistance;
  float tolerance;  ///< by how much a slope must exceed one found here
  /// Times the cell's twist: by how much at most the slope inside the cell exceeds that at both its
  /// ends. Negative where the profile is bent the other way.
  float quarterBulge;
};

/// Crossings that are skipped together, with all that they touch.
struct Group {
  std::size_t begin, end;
  float inverseEnter, inverseLeave;  ///< 1 / r at the begin and the end
  int lowX, lowY, highX, highY;      ///< nodes touched, relative to the texel
};

/// What all texels share for one azimuth.
struct AzimuthPlan {
  RayCrossings ray;
  std::vector<Tap> taps;
  std::vector<Group> groups;
  Group lastCell;
};

/// The state of a chunk of texels in one row. `threshold` is the slope that a farther point must
/// exceed to count as greater.
struct Chunk {
  const float* heights;  ///< of the chunk's first texel in the padded map
  const float* twists;
  std::ptrdiff_t column, row;  ///< of it
  alignas(64) std::array<float, chunkWidth> slope;
  alignas(64) std::array<float, chunkWidth> distance;
  alignas(64) std::array<float, chunkWidth> threshold;
  alignas(64) std::array<std::int32_t, chunkWidth> peaks;  ///< a bit for each crossing of a group
};

/// Slopes that differ by less than this share of the map's range over the distance of the nearer
/// one count as equal: about the sum of the roundings that either may have suffered. Without it a
/// plane's horizon would move to wherever the roundings happen to be favourable.
constexpr float toleranceShare = 16 * 0x1p-24F;

// --- the padded map -----------------------------------------------------------------------------

double paddedTexels(const HeightField& field, double radius) {
  const double margins = 2 * (std::ceil(radius) + 2);
  return (field.width() + margins + chunkWidth) * (field.height() + margins + 1);
}

void fillHeights(const HeightField& field, PaddedMap& map) {
  const double middle = 0.5 * (static_cast<double>(field.minimum()) + field.maximum());
  std::vector<std::size_t> columns(static_cast<std::size_t>(map.stride));
  for (std::ptrdiff_t x = 0; x < map.stride; ++x) {
    columns[static_cast<std::size_t>(x)] = static_cast<std::size_t>(
        wrappedIndex(static_cast<int>(x - map.margin), field.width(), field.wrap()));
  }
  parallelFor(0, static_cast<std::size_t>(map.rows), [&](std::size_t y) {
    const int j = wrappedIndex(static_cast<int>(static_cast<std::ptrdiff_t>(y) - map.margin),
                               field.height(), field.wrap());
    const float* row = field.texels().data() +
                       static_cast<std::size_t>(j) * static_cast<std::size_t>(field.width());
    float* out = map.heights.data() + y * columns.size();
    for (std::size_t x = 0; x < columns.size(); ++x) {
      out[x] = static_cast<float>(row[columns[x]] - middle);
    }
  });
}

void fillTwists(PaddedMap& map) {
  const auto stride = static_cast<std::size_t>(map.stride);
  parallelFor(0, static_cast<std::size_t>(map.rows - 1), [&](std::size_t y) {
    const float* lower = map.heights.data() + y * stride;
    const float* upper = lower + stride;
    float* out = map.twists.data() + y * stride;
    for (std::size_t x = 0; x + 1 < stride; ++x) {
      out[x] = (lower[x] - lower[x + 1]) - (upper[x] - upper[x + 1]);
    }
  });
}

void fillBlockMaxima(PaddedMap& map) {
  const auto stride = static_cast<std::size_t>(map.stride);
  const auto blockStride = static_cast<std::size_t>(map.blockStride);
  const auto rows = static_cast<std::size_t>(map.rows);
  parallelFor(0, map.blockMaxima.size() / blockStride, [&](std::size_t by) {
    float* out = map.blockMaxima.data() + by * blockStride;
    for (std::size_t y = by << blockShift; y < std::min(rows, (by + 1) << blockShift); ++y) {
      const float* in = map.heights.data() + y * stride;
      for (std::size_t x = 0; x < stride; ++x) {
        out[x >> blockShift] = std::max(out[x >> blockShift], in[x]);
      }
    }
  });
}

PaddedMap padMap(const HeightField& field, double radius) {
  PaddedMap map;
  map.margin = static_cast<std::ptrdiff_t>(std::ceil(radius)) + 2;
  map.stride = field.width() + 2 * map.margin + chunkWidth;
  map.rows = field.height() + 2 * map.margin + 1;
  const auto texels = static_cast<std::size_t>(map.stride * map.rows);
  map.heights.resize(texels);
  map.twists.resize(texels);
  map.blockStride = (map.stride >> blockShift) + 1;
  map.blockMaxima.assign(static_cast<std::size_t>(map.blockStride * ((map.rows >> blockShift) + 1)),
                         -std::numeric_limits<float>::infinity());
  fillHeights(field, map);
  fillTwists(map);
  fillBlockMaxima(map);
  const double middle = 0.5 * (static_cast<double>(field.minimum()) + field.maximum());
  map.maximum = static_cast<float>(field.maximum() - middle);
  map.range = static_cast<float>(static_cast<double>(field.maximum()) - field.minimum());
  return map;
}

// --- the plan of an azimuth ---------------------------------------------------------------------

Tap tapOf(const Crossing& c, Vec2 e, const PaddedMap& map) {
  const auto offset = [&](Node n) { return n.y * map.stride + n.x; };
  const double within = c.leave - c.enter;
  // In the first cell the slope A + C r has no extremum.
  const double bulge = c.enter > 0 ? -e.x * e.y * within * within / c.enter : 0;
  return {offset(c.from),
          offset(c.to),
          offset(c.cell),
          static_cast<float>(c.share),
          static_cast<float>(c.leave),
          static_cast<float>(1 / c.leave),
          static_cast<float>(toleranceShare * static_cast<double>(map.range) / c.leave),
          static_cast<float>(0.25 * bulge)};
}

Group emptyGroup(std::size_t begin, double enter, double leave) {
  constexpr int most = std::numeric_limits<int>::max();
  return {begin, begin, static_cast<float>(1 / enter), static_cast<float>(1 / leave), most, most,
          -most, -most};
}

void cover(Group& group, Node cell) {
  group.lowX = std::min(group.lowX, cell.x);
  group.lowY = std::min(group.lowY, cell.y);
  group.highX = std::max(group.highX, cell.x + 1);
  group.highY = std::max(group.highY, cell.y + 1);
}

AzimuthPlan planAzimuth(Vec2 direction, double radius, const PaddedMap& map) {
  AzimuthPlan plan{cutRay(direction, radius), {}, {}, {}};
  const std::vector<Crossing>& crossings = plan.ray.crossings;
  plan.taps.reserve(crossings.size());
  for (const Crossing& c : crossings) plan.taps.push_back(tapOf(c, direction, map));
  for (std::size_t begin = 0; begin < crossings.size(); begin += groupSize) {
    const std::size_t end = std::min(begin + groupSize, crossings.size());
    Group group = emptyGroup(begin, crossings[begin].enter, crossings[end - 1].leave);
    group.end = end;
    for (std::size_t k = begin; k < end; ++k) cover(group, crossings[k].cell);
    plan.groups.push_back(group);
  }
  plan.lastCell = emptyGroup(crossings.size(), plan.ray.lastEnter, radius);
  cover(plan.lastCell, plan.ray.lastCell);
  return plan;
}

// --- one chunk ----------------------------------------------------------------------------------

/// The highest texel among all that the group touches from any texel of the chunk, or a bit more.
float highestTouched(const PaddedMap& map, const Chunk& chunk, const Group& group) {
  const std::ptrdiff_t left = (chunk.column + group.lowX) >> blockShift;
  const std::ptrdiff_t right = (chunk.column + chunkWidth - 1 + group.highX) >> blockShift;
  const std::ptrdiff_t bottom = (chunk.row + group.lowY) >> blockShift;
  const std::ptrdiff_t top = (chunk.row + group.highY) >> blockShift;
  float highest = -std::numeric_limits<float>::infinity();
  for (std::ptrdiff_t by = bottom; by <= top; ++by) {
    const float* maxima = map.blockMaxima.data() + by * map.blockStride;
    for (std::ptrdiff_t bx = left; bx <= right; ++bx) highest = std::max(highest, maxima[bx]);
  }
  return highest;
}

/// Offers a slope that lies off the crossings to one texel. Peaks are looked at after their whole
/// group, so a nearer one that equals the best must win.
void offer(Chunk& chunk, std::size_t lane, double slope, double r, double range) {
  const auto distance = static_cast<float>(r);
  const double tolerance = toleranceShare * range / r;
  const bool greater = slope > chunk.threshold[lane];
  const bool equalAndNearer =
      distance < chunk.distance[lane] && slope + tolerance >= chunk.slope[lane];
  if (!greater && !equalAndNearer) return;
  chunk.slope[lane] = static_cast<float>(slope);
  chunk.distance[lane] = distance;
  chunk.threshold[lane] = static_cast<float>(slope + tolerance);
}

/// The bilinear profile g(ρ) = rise + slope ρ + bend ρ² of h - h0 along a ray in one cell, ρ from
/// the point where it enters.
struct Profile {
  double rise, slope, bend;
};

Profile profileInCell(const Chunk& chunk, std::size_t lane, std::ptrdiff_t stride, Vec2 e,
                      Node cell, double enter) {
  const float* corner = chunk.heights + lane + cell.y * stride + cell.x;
  const double h0 = chunk.heights[lane];
  const double h00 = corner[0];
  const double alongX = corner[1] - h00;
  const double alongY = corner[stride] - h00;
  const double twist = corner[stride + 1] - h00 - alongX - alongY;
  const double u = enter * e.x - cell.x;
  const double v = enter * e.y - cell.y;
  return {(h00 - h0) + alongX * u + alongY * v + twist * u * v,
          alongX * e.x + alongY * e.y + twist * (u * e.y + v * e.x), twist * e.x * e.y};
}

/// The maximum of g(ρ) / (enter + ρ) inside a cell, where there is one: its derivative vanishes at
/// bend ρ² + 2 bend enter ρ + slope enter - rise = 0.
void offerPeak(Chunk& chunk, std::size_t lane, const Profile& g, double enter, double leave,
               double range) {
  const double climb = g.slope * enter - g.rise;
  if (!(g.bend < 0) || !(climb > 0)) return;
  const double x = -climb / g.bend;
  const double rho = x / (enter + std::sqrt(enter * enter + x));
  if (!(rho < leave - enter)) return;
  const double r = enter + rho;
  offer(chunk, lane, (g.rise + rho * (g.slope + rho * g.bend)) / r, r, range);
}

void offerMarkedPeaks(const PaddedMap& map, const AzimuthPlan& plan, const Group& group,
                      std::size_t begin, std::size_t end, Chunk& chunk) {
  for (std::size_t lane = begin; lane < end; ++lane) {
    for (auto bits = static_cast<std::uint32_t>(chunk.peaks[lane]); bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<std::size_t>(__builtin_ctz(bits));
      const Crossing& c = plan.ray.crossings[group.begin + bit];
      const Profile g = profileInCell(chunk, lane, map.stride, plan.ray.direction, c.cell, c.enter);
      offerPeak(chunk, lane, g, c.enter, c.leave, map.range);
    }
  }
}

/// The end of the ray inside its last cell, and a peak before it.
void finishLastCell(const PaddedMap& map, const AzimuthPlan& plan, std::size_t begin,
                    std::size_t end, Chunk& chunk) {
  const double enter = plan.ray.lastEnter;
  const double rho = plan.ray.radius - enter;
  for (std::size_t lane = begin; lane < end; ++lane) {
    const Profile g =
        profileInCell(chunk, lane, map.stride, plan.ray.direction, plan.ray.lastCell, enter);
    if (enter > 0) offerPeak(chunk, lane, g, enter, plan.ray.radius, map.range);
    const double slope = (g.rise + rho * (g.slope + rho * g.bend)) / plan.ray.radius;
    if (slope > chunk.threshold[lane]) offer(chunk, lane, slope, plan.ray.radius, map.range);
  }
}

// The functions below are compiled for several vector widths: `lanes` floats at once. They pass
// vectors by reference only, since how they pass by value depends on the processor, and they use
// each comparison for one selection only, since gcc 12 combines the results of several one lane at
// a time.
#define GNOMON_INLINE inline __attribute__((always_inline))

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

/// The limit r → 0⁺: the directional derivative.
GNOMON_INLINE void startChunk(const PaddedMap& map, Vec2 direction, Chunk& chunk) {
  const std::ptrdiff_t alongX = direction.x < 0 ? -1 : 1;
  const std::ptrdiff_t alongY = direction.y < 0 ? -map.stride : map.stride;
  const auto ex = static_cast<float>(std::abs(direction.x));
  const auto ey = static_cast<float>(std::abs(direction.y));
  const float tolerance = toleranceShare * map.range;
  for (std::size_t i = 0; i < chunkWidth; ++i) {
    const float* h = chunk.heights + i;
    chunk.slope[i] = ex * (h[alongX] - h[0]) + ey * (h[alongY] - h[0]);
    chunk.distance[i] = 0;
    chunk.threshold[i] = chunk.slope[i] + tolerance;
  }
}

/// What a vector of texels holds while it meets a group.
template <int lanes>
struct Lanes {
  using Floats = typename Vector<lanes>::Floats;
  Floats h0, slope;
  const float* heights;
  const float* twists;
};

template <int lanes>
GNOMON_INLINE void loadLanes(const Chunk& chunk, std::size_t first, Lanes<lanes>& at) {
  at.heights = chunk.heights + first;
  at.twists = chunk.twists + first;
  load(at.h0, at.heights);
  load(at.slope, chunk.slope.data() + first);
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

/// The slope where a group begins.
template <int lanes>
GNOMON_INLINE void slopeBefore(const AzimuthPlan& plan, const Group& group, const Lanes<lanes>& at,
                               typename Vector<lanes>::Floats& slope) {
  slope = at.slope;
  if (group.begin > 0) slopeAt<lanes>(at, plan.taps[group.begin - 1], slope);
}

/// Whether a crossing of the group, or the inside of a cell, exceeds the horizon of any texel: the
/// same bounds as in `takeGroup`, which does more work.
template <int lanes>
GNOMON_INLINE bool groupRaises(const AzimuthPlan& plan, const Group& group,
                               const Lanes<lanes>& at) {
  using Floats = typename Vector<lanes>::Floats;
  Floats previous, candidate, twist;
  slopeBefore<lanes>(plan, group, at, previous);
  Floats most = at.slope;
  for (std::size_t k = group.begin; k < group.end; ++k) {
    const Tap& tap = plan.taps[k];
    slopeAt<lanes>(at, tap, candidate);
    load(twist, at.twists + tap.cell);
    const Floats higher = candidate > previous ? candidate : previous;
    const Floats bound = higher + twist * tap.quarterBulge;
    most = candidate > most ? candidate : most;
    most = bound > most ? bound : most;
    previous = candidate;
  }
  const Floats excess = most - at.slope;
  return anyPositive<lanes>(excess);
}

/// Takes every crossing of a group in order and marks the cells whose inside may hold a slope that
/// is greater still.
template <int lanes>
GNOMON_INLINE void takeGroup(const AzimuthPlan& plan, const Group& group, std::size_t first,
                             const Lanes<lanes>& at, Chunk& chunk) {
  using Floats = typename Vector<lanes>::Floats;
  using Ints = typename Vector<lanes>::Ints;
  const Ints none{};
  Ints peaks = none;
  Ints bit = none + 1;
  Floats previous, candidate, distance, threshold, twist;
  Floats slope = at.slope;
  load(distance, chunk.distance.data() + first);
  load(threshold, chunk.threshold.data() + first);
  slopeBefore<lanes>(plan, group, at, previous);
  for (std::size_t k = group.begin; k < group.end; ++k) {
    const Tap& tap = plan.taps[k];
    slopeAt<lanes>(at, tap, candidate);
    load(twist, at.twists + tap.cell);
    const Ints greater = candidate > threshold;
    slope = greater ? candidate : slope;
    distance = greater ? tap.distance - Floats{} : distance;
    threshold = greater ? candidate + tap.tolerance : threshold;
    // A peak inside needs a change of slope across the cell of less than the bulge.
    const Floats quarter = twist * tap.quarterBulge;
    const Floats change = candidate - previous;
    const Floats size = change > 0 ? change : -change;
    const Floats excess = (change > 0 ? candidate : previous) + quarter - slope;
    const Floats room = 4 * quarter - size;
    const Floats both = excess < room ? excess : room;
    peaks |= both > 0 ? bit : none;
    bit += bit;
    previous = candidate;
  }
  store(slope, chunk.slope.data() + first);
  store(distance, chunk.distance.data() + first);
  store(threshold, chunk.threshold.data() + first);
  store(peaks, chunk.peaks.data() + first);
}

/// One group for a whole chunk. False if nothing beyond it can raise any horizon.
template <int lanes>
GNOMON_INLINE bool meetGroup(const PaddedMap& map, const AzimuthPlan& plan, const Group& group,
                             Chunk& chunk) {
  const float highest = highestTouched(map, chunk, group);
  bool open = false;
  for (std::size_t first = 0; first < chunkWidth; first += lanes) {
    Lanes<lanes> at;
    loadLanes<lanes>(chunk, first, at);
    if (!canRaise<lanes>(at, highest, group.inverseEnter, group.inverseLeave)) {
      open = open || canRaise<lanes>(at, map.maximum, group.inverseLeave, 0);
      continue;
    }
    open = true;
    // The first group raises nearly every horizon: no need to ask.
    if (group.begin > 0 && !groupRaises<lanes>(plan, group, at)) continue;
    takeGroup<lanes>(plan, group, first, at, chunk);
    offerMarkedPeaks(map, plan, group, first, first + lanes, chunk);
  }
  return open;
}

/// The cell in which the ray ends, for those texels whose horizon it could raise.
template <int lanes>
GNOMON_INLINE void meetLastCell(const PaddedMap& map, const AzimuthPlan& plan, Chunk& chunk) {
  const Group& cell = plan.lastCell;
  const float highest = highestTouched(map, chunk, cell);
  for (std::size_t first = 0; first < chunkWidth; first += lanes) {
    Lanes<lanes> at;
    loadLanes<lanes>(chunk, first, at);
    if (canRaise<lanes>(at, highest, cell.inverseEnter, cell.inverseLeave)) {
      finishLastCell(map, plan, first, first + lanes, chunk);
    }
  }
}

template <int lanes>
GNOMON_INLINE void bakeChunkWith(const PaddedMap& map, const AzimuthPlan& plan, Chunk& chunk) {
  startChunk(map, plan.ray.direction, chunk);
  for (const Group& group : plan.groups) {
    if (!meetGroup<lanes>(map, plan, group, chunk)) return;
  }
  if (plan.ray.lastEnter < plan.ray.radius) meetLastCell<lanes>(map, plan, chunk);
}

using BakeChunk = void (*)(const PaddedMap&, const AzimuthPlan&, Chunk&);

void bakeChunkNarrow(const PaddedMap& map, const AzimuthPlan& plan, Chunk& chunk) {
  bakeChunkWith<4>(map, plan, chunk);
}

#if GNOMON_WIDE_VECTORS
__attribute__((target("avx2"))) void bakeChunkAvx2(const PaddedMap& map, const AzimuthPlan& plan,
                                                   Chunk& chunk) {
  bakeChunkWith<8>(map, plan, chunk);
}

__attribute__((target("avx512f,avx512dq,avx512vl,avx512bw"))) void bakeChunkAvx512(
    const PaddedMap& map, const AzimuthPlan& plan, Chunk& chunk) {
  bakeChunkWith<16>(map, plan, chunk);
}
#endif

BakeChunk chunkBaker() {
#if GNOMON_WIDE_VECTORS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw")) {
    return bakeChunkAvx512;
  }
  if (__builtin_cpu_supports("avx2")) return bakeChunkAvx2;
#endif
  return bakeChunkNarrow;
}

// --- the whole map ------------------------------------------------------------------------------

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

void checkMemory(const HeightField& field, const BakeSettings& settings) {
  const double texels = static_cast<double>(field.width()) * field.height();
  const double padded = paddedTexels(field, settings.radiusTexels);
  const double crossings = 1.5 * settings.radiusTexels + 2;
  const double bytes = 2 * sizeof(float) * texels * settings.azimuths +
                       2 * sizeof(float) * 1.01 * padded +
                       (sizeof(Crossing) + sizeof(Tap)) * crossings * settings.azimuths;
  requireMemory(
      bytes, fmt::format("bake.azimuths = {} and bake.radius = {} on a map of {} x {} "
                         "texels",
                         settings.azimuths, settings.radiusTexels, field.width(), field.height()));
}

HorizonTables emptyTables(const HeightField& field, const BakeSettings& settings) {
  HorizonTables tables;
  tables.width = field.width();
  tables.height = field.height();
  tables.azimuths = settings.azimuths;
  tables.radiusTexels = settings.radiusTexels;
  tables.wrap = field.wrap();
  const std::size_t entries = static_cast<std::size_t>(field.width()) *
                              static_cast<std::size_t>(field.height()) *
                              static_cast<std::size_t>(settings.azimuths);
  tables.horizon.resize(entries);
  tables.distance.resize(entries);
  return tables;
}

/// A column of chunks, `tileRows` high, of one azimuth: what a thread takes at once. Rays of
/// neighbouring rows read the same texels, so that these stay in its cache.
struct Tile {
  std::size_t azimuth;
  int column, row;
};

class Tiling {
 public:
  Tiling(const HeightField& field, int azimuths)
      : across_((field.width() + chunkWidth - 1) / chunkWidth),
        up_((field.height() + tileRows - 1) / tileRows),
        azimuths_(static_cast<std::size_t>(azimuths)) {}

  [[nodiscard]] std::size_t count() const { return azimuths_ * perAzimuth(); }
  [[nodiscard]] Tile tile(std::size_t index) const {
    const auto within = static_cast<int>(index % perAzimuth());
    return {index / perAzimuth(), within % across_ * chunkWidth, within / across_ * tileRows};
  }

 private:
  [[nodiscard]] std::size_t perAzimuth() const {
    return static_cast<std::size_t>(across_) * static_cast<std::size_t>(up_);
  }
  int across_, up_;
  std::size_t azimuths_;
};

void bakeTile(const PaddedMap& map, const AzimuthPlan& plan, const Tile& tile, BakeChunk bakeChunk,
              HorizonTables& tables) {
  const auto width = static_cast<std::size_t>(tables.width);
  const auto count =
      std::min<std::size_t>(chunkWidth, width - static_cast<std::size_t>(tile.column));
  Chunk chunk;
  for (int y = tile.row; y < std::min(tile.row + tileRows, tables.height); ++y) {
    chunk.column = map.margin + tile.column;
    chunk.row = map.margin + y;
    const std::ptrdiff_t origin = chunk.row * map.stride + chunk.column;
    chunk.heights = map.heights.data() + origin;
    chunk.twists = map.twists.data() + origin;
    bakeChunk(map, plan, chunk);
    const std::size_t first =
        (tile.azimuth * static_cast<std::size_t>(tables.height) + static_cast<std::size_t>(y)) *
            width +
        static_cast<std::size_t>(tile.column);
    std::copy_n(chunk.slope.begin(), count,
                tables.horizon.begin() + static_cast<std::ptrdiff_t>(first));
    std::copy_n(chunk.distance.begin(), count,
                tables.distance.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

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

HorizonTables bakeHorizons(const HeightField& field, const BakeSettings& settings,
                           const Progress& progress) {
  checkSettings(settings);
  checkHeights(field);
  checkMemory(field, settings);
  const PaddedMap map = padMap(field, settings.radiusTexels);
  std::vector<AzimuthPlan> plans(static_cast<std::size_t>(settings.azimuths));
  parallelFor(0, plans.size(), [&](std::size_t m) {
    plans[m] = planAzimuth(azimuthDirection(static_cast<int>(m), settings.azimuths),
                           settings.radiusTexels, map);
  });
  HorizonTables tables = emptyTables(field, settings);
  const Tiling tiling(field, settings.azimuths);
  const BakeChunk bakeChunk = chunkBaker();
  Counter counter(progress, tiling.count());
  parallelFor(0, tiling.count(), [&](std::size_t index) {
    const Tile tile = tiling.tile(index);
    bakeTile(map, plans[tile.azimuth], tile, bakeChunk, tables);
    counter.add();
  });
  return tables;
}

}  // namespace gnomon
