#include "relief/horizon_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/raw_buffer.h"

// This file is compiled once for each of these instruction sets; the processor that runs it
// decides.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "relief/horizon_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace gnomon {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using Lanes = hn::ScalableTag<float>;
using Floats = hn::Vec<Lanes>;
constexpr Lanes lanes;

constexpr std::size_t groupTaps = AzimuthPlan::groupTaps;
constexpr std::size_t bundleGroups = AzimuthPlan::bundleGroups;
constexpr float never = std::numeric_limits<float>::infinity();
constexpr float farthest = std::numeric_limits<float>::max();  ///< times 0 it is still 0

/// What a vector of texels found so far. Slots of visited groups and peaks keep what the distances
/// are found from, once the greatest slope is known.
class Notes {
 public:
  explicit Notes(const AzimuthPlan& plan)
      : groups_(plan.groups.size() + 1),
        slopes_(groups_ * groupTaps * hn::Lanes(lanes)),
        highest_(groups_ * hn::Lanes(lanes)),
        peaks_(2 * (plan.taps.size() + 1) * hn::Lanes(lanes)),
        visited(groups_) {}

  HWY_INLINE float* slopes(std::size_t visit) {
    return slopes_.data() + visit * groupTaps * hn::Lanes(lanes);
  }
  HWY_INLINE float* highest(std::size_t visit) {
    return highest_.data() + visit * hn::Lanes(lanes);
  }
  HWY_INLINE float* peak(std::size_t index) { return peaks_.data() + 2 * index * hn::Lanes(lanes); }

 private:
  std::size_t groups_;
  RawBuffer<float> slopes_, highest_, peaks_;

 public:
  RawBuffer<std::uint32_t> visited;  ///< groups, by visit
  std::size_t visits = 0;
  std::size_t peaks = 0;
};

/// Groups that attain a horizon of a vector of texels.
using Winners = std::vector<std::uint32_t>;

/// A vector of neighbouring texels and their rays.
struct Texels {
  const float* heights;  ///< of the first
  const float* twists;
  std::ptrdiff_t column, row;  ///< in the padded map
  Floats height;
  Floats reach;  ///< height less what keeps roundings from hiding an equal
  Floats best;   ///< greatest slope so far
};

/// Whether a height up to `highest` between two distances could equal or exceed any horizon.
HWY_INLINE bool canRaise(const Texels& at, Floats highest, float enter, float leave) {
  const Floats near = hn::Add(at.reach, hn::Mul(at.best, hn::Set(lanes, enter)));
  const Floats far = hn::Add(at.reach, hn::Mul(at.best, hn::Set(lanes, leave)));
  return !hn::AllFalse(lanes, hn::Gt(highest, hn::Min(near, far)));
}

HWY_INLINE Floats boundOf(const AzimuthBake& bake, const BoxMaxima& maxima, const Texels& at,
                          Node corner) {
  const std::ptrdiff_t row = (at.row + corner.y) >> maxima.rowShift;
  return hn::LoadU(lanes, maxima.highest.data() + row * bake.map.stride + at.column + corner.x);
}

HWY_INLINE Floats slopeAt(const Texels& at, const Tap& tap) {
  const Floats from = hn::LoadU(lanes, at.heights + tap.from);
  const Floats to = hn::LoadU(lanes, at.heights + tap.to);
  const Floats h = hn::Add(from, hn::Mul(hn::Set(lanes, tap.share), hn::Sub(to, from)));
  return hn::Mul(hn::Sub(h, at.height), hn::Set(lanes, tap.inverseDistance));
}

HWY_INLINE void takeGroup(const AzimuthPlan& plan, std::size_t group, Texels& at, Notes& notes) {
  const Tap* taps = plan.taps.data() + group * groupTaps;
  float* slopes = notes.slopes(notes.visits);
  Floats highest = hn::Set(lanes, -never);
  for (std::size_t k = 0; k < groupTaps; ++k) {
    const Floats slope = slopeAt(at, taps[k]);
    hn::Store(slope, lanes, slopes + k * hn::Lanes(lanes));
    highest = hn::Max(highest, slope);
  }
  hn::Store(highest, lanes, notes.highest(notes.visits));
  notes.visited[notes.visits++] = static_cast<std::uint32_t>(group);
  at.best = hn::Max(at.best, highest);
}

/// The limit r → 0⁺: the directional derivative.
HWY_INLINE Floats derivative(const AzimuthBake& bake, const Texels& at) {
  const Vec2 e = bake.plan.direction;
  const std::ptrdiff_t alongX = e.x < 0 ? -1 : 1;
  const std::ptrdiff_t alongY = e.y < 0 ? -bake.map.stride : bake.map.stride;
  const Floats x = hn::Sub(hn::LoadU(lanes, at.heights + alongX), at.height);
  const Floats y = hn::Sub(hn::LoadU(lanes, at.heights + alongY), at.height);
  return hn::Add(hn::Mul(hn::Set(lanes, static_cast<float>(std::abs(e.x))), x),
                 hn::Mul(hn::Set(lanes, static_cast<float>(std::abs(e.y))), y));
}

/// Takes the groups that won in the row before, so that most others need no look.
HWY_INLINE void takeWinners(const AzimuthPlan& plan, const Winners& winners, Texels& at,
                            Notes& notes) {
  for (const std::uint32_t group : winners) takeGroup(plan, group, at, notes);
}

/// Which of up to 32 stretches could raise a horizon: bit k for the k-th. No branches: which way
/// they go is hard to foresee.
HWY_INLINE std::uint32_t raising(const AzimuthBake& bake, const BoxMaxima& maxima,
                                 const Stretch* stretches, std::size_t count, const Texels& at) {
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Stretch& s = stretches[k];
    const Floats highest = boundOf(bake, maxima, at, s.corner);
    bits |= std::uint32_t{canRaise(at, highest, s.enter, s.leave)} << k;
  }
  return bits;
}

/// Takes every other group, from near to far, that could raise a horizon.
HWY_INLINE void sweep(const AzimuthBake& bake, Texels& at, Notes& notes) {
  constexpr std::size_t batch = 16;
  const AzimuthPlan& plan = bake.plan;
  const Floats top = hn::Set(lanes, bake.map.maximum);
  const std::size_t known = notes.visits;
  for (std::size_t first = 0; first < plan.bundles.size(); first += batch) {
    if (!canRaise(at, top, plan.bundles[first].enter, farthest)) return;
    const std::size_t count = std::min(batch, plan.bundles.size() - first);
    std::uint32_t open = raising(bake, bake.bundles, plan.bundles.data() + first, count, at);
    for (; open != 0; open &= open - 1) {
      const std::size_t bundle = first + static_cast<std::size_t>(std::countr_zero(open));
      const std::size_t group = bundle * bundleGroups;
      std::uint32_t bits = raising(bake, bake.groups, plan.groups.data() + group,
                                   std::min(bundleGroups, plan.groups.size() - group), at);
      for (std::size_t visit = 0; visit < known; ++visit) {
        const std::size_t k = notes.visited[visit] - group;
        bits &= ~(std::uint32_t{k < bundleGroups} << (k % bundleGroups));
      }
      for (; bits != 0; bits &= bits - 1) {
        takeGroup(plan, group + static_cast<std::size_t>(std::countr_zero(bits)), at, notes);
      }
    }
  }
}

// --- peaks --------------------------------------------------------------------------------------

/// The peak of the slope inside a cell that is entered at r₀ with slope s₀: with a the derivative
/// of the height there, C = -c its bend and w = a - s₀, x = r - r₀ solves c x² + 2 c r₀ x = r₀ w,
/// and the slope at it is s₀ + c x² / r₀.
HWY_INLINE void takePeak(const AzimuthBake& bake, const CellPath& path, Floats before, Texels& at,
                         Notes& notes) {
  const std::ptrdiff_t stride = bake.map.stride;
  const float* corner = at.heights + path.cell;
  const Vec2 e = bake.plan.direction;
  const Floats h00 = hn::LoadU(lanes, corner);
  const Floats alongX = hn::Sub(hn::LoadU(lanes, corner + 1), h00);
  const Floats alongY = hn::Sub(hn::LoadU(lanes, corner + stride), h00);
  const Floats twist = hn::LoadU(lanes, at.twists + path.cell);
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
  float* note = notes.peak(notes.peaks++);
  hn::Store(slope, lanes, note);
  hn::Store(hn::IfThenElse(inside, hn::Add(enter, x), enter), lanes, note + hn::Lanes(lanes));
  at.best = hn::Max(at.best, slope);
}

/// Whether a cell may hold a peak that equals or exceeds a horizon, given the slopes at its ends: a
/// quarter of the bulge above the higher one must reach it, and they must differ by less than the
/// bulge.
HWY_INLINE bool mayPeak(const CellPath& path, Floats before, Floats after, Floats least,
                        const Texels& at) {
  const Floats twist = hn::LoadU(lanes, at.twists + path.cell);
  const Floats bulge = hn::Mul(twist, hn::Set(lanes, path.quarterBulge));
  const auto reaches = hn::Ge(hn::Add(hn::Max(before, after), bulge), least);
  const Floats bend = hn::Mul(bulge, hn::Set(lanes, 4.F));
  return !hn::AllFalse(lanes, hn::And(reaches, hn::Gt(bend, hn::Abs(hn::Sub(after, before)))));
}

HWY_INLINE void takePeaks(const AzimuthBake& bake, std::size_t visit, Texels& at, Notes& notes) {
  const AzimuthPlan& plan = bake.plan;
  const std::size_t group = notes.visited[visit];
  const CellPath* cells = plan.cells.data() + group * groupTaps;
  HWY_ALIGN std::array<float, HWY_MAX_BYTES / sizeof(float)> first;
  const Floats least = hn::Sub(at.best, hn::Set(lanes, plan.groups[group].tolerance));
  Floats before = group > 0 ? slopeAt(at, plan.taps[group * groupTaps - 1]) : least;
  std::uint32_t bits = 0;
  const float* slopes = notes.slopes(visit);
  hn::Store(before, lanes, first.data());
  for (std::size_t k = 0; k < groupTaps; ++k) {
    const Floats after = hn::Load(lanes, slopes + k * hn::Lanes(lanes));
    bits |= std::uint32_t{mayPeak(cells[k], before, after, least, at)} << k;
    before = after;
  }
  for (; bits != 0; bits &= bits - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(bits));
    const float* end = k > 0 ? slopes + (k - 1) * hn::Lanes(lanes) : first.data();
    takePeak(bake, cells[k], hn::Load(lanes, end), at, notes);
  }
}

/// The end of the ray inside a cell, r = D, and a peak before it.
/// @returns the slope at the end
HWY_INLINE Floats takeEnd(const AzimuthBake& bake, Floats start, Texels& at, Notes& notes) {
  const AzimuthPlan& plan = bake.plan;
  const CellPath& path = plan.lastCell;
  const Floats twist = hn::LoadU(lanes, at.twists + path.cell);
  if (plan.taps.empty()) {  // the first cell: the slope is linear, without a peak
    const Floats change = hn::Mul(twist, hn::Set(lanes, path.bend * path.length));
    const Floats slope = hn::Sub(start, change);
    at.best = hn::Max(at.best, slope);
    return slope;
  }
  const float* corner = at.heights + path.cell;
  const Floats u = hn::Set(lanes, path.u + path.length * static_cast<float>(plan.direction.x));
  const Floats v = hn::Set(lanes, path.v + path.length * static_cast<float>(plan.direction.y));
  const Floats h00 = hn::LoadU(lanes, corner);
  const Floats alongX = hn::Sub(hn::LoadU(lanes, corner + 1), h00);
  const Floats alongY = hn::Sub(hn::LoadU(lanes, corner + bake.map.stride), h00);
  const Floats h =
      hn::Add(hn::Add(h00, hn::Mul(u, alongX)), hn::Mul(v, hn::Add(alongY, hn::Mul(u, twist))));
  const Floats inverse = hn::Set(lanes, static_cast<float>(1 / plan.radius));
  const Floats slope = hn::Mul(hn::Sub(h, at.height), inverse);
  at.best = hn::Max(at.best, slope);
  const Floats before = slopeAt(at, plan.taps.back());
  const Floats least = hn::Sub(at.best, hn::Set(lanes, plan.end.tolerance));
  if (mayPeak(path, before, slope, least, at)) takePeak(bake, path, before, at, notes);
  return slope;
}

// --- distances ----------------------------------------------------------------------------------

/// Lets `distance` be r where a slope there equals the horizon and nothing nearer does.
HWY_INLINE void offer(Floats slope, Floats r, Floats least, Floats& distance) {
  distance = hn::IfThenElse(hn::Ge(slope, least), hn::Min(distance, r), distance);
}

HWY_INLINE Floats nearest(const AzimuthBake& bake, const Texels& at, Floats start, Notes& notes,
                          Winners& winners) {
  const AzimuthPlan& plan = bake.plan;
  const Floats best = at.best;
  Floats distance = hn::Set(lanes, never);
  offer(start, hn::Zero(lanes), hn::Sub(best, hn::Set(lanes, bake.map.tolerance)), distance);
  winners.clear();
  for (std::size_t visit = 0; visit < notes.visits; ++visit) {
    const std::size_t g = notes.visited[visit];
    const Floats highest = hn::Load(lanes, notes.highest(visit));
    const Floats least = hn::Sub(best, hn::Set(lanes, plan.groups[g].tolerance));
    if (hn::AllFalse(lanes, hn::Ge(highest, least))) continue;
    winners.push_back(static_cast<std::uint32_t>(g));
    const float* slopes = notes.slopes(visit);
    const Tap* taps = plan.taps.data() + g * groupTaps;
    for (std::size_t k = 0; k < groupTaps; ++k) {
      offer(hn::Load(lanes, slopes + k * hn::Lanes(lanes)), hn::Set(lanes, taps[k].distance),
            hn::Sub(best, hn::Set(lanes, taps[k].tolerance)), distance);
    }
  }
  for (std::size_t p = 0; p < notes.peaks; ++p) {
    const float* peak = notes.peak(p);
    const Floats slope = hn::Load(lanes, peak);
    const Floats r = hn::Load(lanes, peak + hn::Lanes(lanes));
    const Floats room =
        hn::Div(hn::Set(lanes, bake.map.tolerance), hn::Max(r, hn::Set(lanes, 1.F)));
    offer(slope, r, hn::Sub(best, room), distance);
  }
  return distance;
}

/// One vector of texels. `winners` are those of the row before, then its own.
HWY_INLINE void bakeTexels(const AzimuthBake& bake, std::ptrdiff_t column, std::ptrdiff_t row,
                           Notes& notes, Winners& winners, float* horizon, float* distance) {
  const AzimuthPlan& plan = bake.plan;
  Texels at;
  at.column = column;
  at.row = row;
  at.heights = bake.map.heights.data() + row * bake.map.stride + column;
  at.twists = bake.map.twists.data() + row * bake.map.stride + column;
  at.height = hn::LoadU(lanes, at.heights);
  at.reach = hn::Sub(at.height, hn::Set(lanes, 2 * bake.map.tolerance));
  const Floats start = derivative(bake, at);
  at.best = start;
  notes.visits = 0;
  notes.peaks = 0;
  takeWinners(plan, winners, at, notes);
  sweep(bake, at, notes);
  for (std::size_t visit = 0; visit < notes.visits; ++visit) {
    const Stretch& group = plan.groups[notes.visited[visit]];
    const Floats highest = hn::Load(lanes, notes.highest(visit));
    const Floats least = hn::Sub(at.best, hn::Set(lanes, group.tolerance + group.peakRoom));
    if (group.peakRoom > 0 && !hn::AllFalse(lanes, hn::Ge(highest, least))) {
      takePeaks(bake, visit, at, notes);
    }
  }
  const bool end = plan.endsInCell && canRaise(at, boundOf(bake, bake.groups, at, plan.end.corner),
                                               plan.end.enter, plan.end.leave);
  const Floats atEnd = end ? takeEnd(bake, start, at, notes) : hn::Set(lanes, -never);
  Floats r = nearest(bake, at, start, notes, winners);
  if (end) {
    offer(atEnd, hn::Set(lanes, plan.end.leave),
          hn::Sub(at.best, hn::Set(lanes, plan.end.tolerance)), r);
  }
  hn::StoreU(at.best, lanes, horizon);
  hn::StoreU(r, lanes, distance);
}

void bakeTile(const AzimuthBake& bake, const TexelTile& tile, std::ptrdiff_t stride, float* horizon,
              float* distance) {
  const PaddedMap& map = bake.map;
  const auto vector = static_cast<int>(hn::Lanes(lanes));
  Notes notes(bake.plan);
  std::vector<Winners> winners(static_cast<std::size_t>((tile.right - tile.left) / vector + 1));
  if (!bake.plan.groups.empty()) std::fill(winners.begin(), winners.end(), Winners{0});
  for (int y = tile.bottom; y < tile.top; ++y) {
    const std::ptrdiff_t row = map.marginY + y;
    for (int x = tile.left; x < tile.right; x += vector) {
      const std::ptrdiff_t to = (y - tile.bottom) * stride + (x - tile.left);
      const std::ptrdiff_t column = map.marginX + x;
      Winners& known = winners[static_cast<std::size_t>((x - tile.left) / vector)];
      if (x + vector <= tile.right) {
        bakeTexels(bake, column, row, notes, known, horizon + to, distance + to);
        continue;
      }
      HWY_ALIGN std::array<float, HWY_MAX_BYTES / sizeof(float)> slopes, distances;
      bakeTexels(bake, column, row, notes, known, slopes.data(), distances.data());
      std::copy_n(slopes.begin(), tile.right - x, horizon + to);
      std::copy_n(distances.begin(), tile.right - x, distance + to);
    }
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

void bakeTile(const AzimuthBake& bake, const TexelTile& tile, std::ptrdiff_t stride, float* horizon,
              float* distance) {
  HWY_DYNAMIC_DISPATCH(bakeTile)(bake, tile, stride, horizon, distance);
}

const char* bakeInstructionSet() {
  return HWY_DYNAMIC_DISPATCH(instructionSet)();
}

}  // namespace gnomon
#endif
