#include "compare/shadow_length.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>

#include "common/error.h"
#include "common/lists.h"
#include "common/parallel.h"
#include "common/vec.h"
#include "compare/answer_metrics.h"
#include "compare/answer_pair.h"

namespace gnomon::compare {
namespace {

/// Where lines start in a sample: points (k, 4 k) / 17 of a lattice around its centre. Their
/// columns all differ and so do their rows, so that both are evenly spread; and since 4² = -1 (mod
/// 17) a quarter turn of the picture leaves them as they are.
constexpr int linesPerRun = 17;

Vec2 lineStart(int k) {
  constexpr int half = linesPerRun / 2;
  const auto centred = [](int i) {
    return (i % linesPerRun + linesPerRun + half) % linesPerRun - half;
  };
  return Vec2(centred(k), centred(4 * k)) / double{linesPerRun};
}

/// A walk over the samples of a view, away from the light or toward it.
class Walk {
 public:
  enum class Heading { away = 1, toward = -1 };

  /// @param start     a sample
  /// @param position  in it, columns and rows
  Walk(const LightField& field, std::size_t start, Vec2 position, Heading heading)
      : field_(field), sign_(static_cast<int>(heading)), index_(start), position_(position) {}

  [[nodiscard]] std::size_t index() const { return index_; }
  [[nodiscard]] double length() const { return field_.steps[index_].length; }

  /// Goes on by one step; false where it cannot.
  [[nodiscard]] bool advance() {
    if (++taken_ > 4 * (field_.width + field_.height)) return false;  // a field that leads in rings
    const Vec2 next = position_ + sign_ * Vec2(field_.steps[index_].away);
    const Vec2 nearest = next + 0.5;  // rounded down
    if (!(nearest.x >= 0 && nearest.y >= 0 && nearest.x < field_.width &&
          nearest.y < field_.height)) {
      return false;
    }
    const auto there = static_cast<std::size_t>(
        static_cast<std::int64_t>(nearest.y) * field_.width + static_cast<std::int64_t>(nearest.x));
    if (!hasDirection(field_, there) || isBreak(index_, there)) return false;
    position_ = next;
    index_ = there;
    return true;
  }

  [[nodiscard]] static bool hasDirection(const LightField& field, std::size_t i) {
    return field.steps[i].away != glm::vec2(0);
  }

 private:
  [[nodiscard]] bool isBreak(std::size_t a, std::size_t b) const {
    const LightStep& from = field_.steps[a];
    const LightStep& to = field_.steps[b];
    return tileOf(a) != tileOf(b) ||
           glm::distance(from.place, to.place) > std::min(from.spacing, to.spacing);
  }
  [[nodiscard]] std::array<std::size_t, 2> tileOf(std::size_t i) const {
    if (field_.tileSide == 0) return {0, 0};
    const auto width = static_cast<std::size_t>(field_.width);
    const auto side = static_cast<std::size_t>(field_.tileSide);
    return {i % width / side, i / width / side};
  }

  const LightField& field_;
  double sign_;
  std::size_t index_;
  Vec2 position_;
  int taken_ = 0;
};

/// One bit a candidate.
using Candidates = std::uint64_t;

/// What a walk asks of a sample, in one word: whether the truth shadows it, whether the truth and,
/// in a group, all candidates alike have an answer there, whether it is selected, and which
/// candidates shadow it.
constexpr unsigned darkBit = 1;
constexpr unsigned answersBit = 2;
constexpr unsigned selectedBit = 4;
constexpr std::size_t firstCandidateBit = 3;

/// How many candidates there is room for in addition to those.
template <typename Word>
constexpr std::size_t mostCandidatesIn = 8 * sizeof(Word) - firstCandidateBit;
static_assert(mostCandidatesAtOnce <= mostCandidatesIn<std::uint64_t>);

/// Calls `act(c)` for every candidate of a set.
template <typename Act>
void forEach(Candidates set, const Act& act) {
  for (; set != 0; set &= set - 1) act(static_cast<std::size_t>(std::countr_zero(set)));
}

/// What is measured: the truth's lengths, and each candidate's in the same runs.
struct Runs {
  explicit Runs(std::size_t candidates) : ratios(candidates) {}

  std::vector<double> truth;
  std::vector<std::vector<double>> ratios;  ///< of each candidate's length over the truth's
};

/// Follows every run of the truth once for a group of candidates (see answer_pair.h). Candidates
/// whose sums are the truth's own so far share that.
/// @tparam Word  of a sample's bits: walks look at scattered samples, so that small words keep more
///   of them near
template <typename Word>
class RunFinder {
 public:
  /// @param candidates  at most mostCandidatesIn<Word>
  RunFinder(std::span<const Mask* const> candidates, const Mask& truth, const LightField& field,
            std::span<const std::uint8_t> selected)
      : count_(candidates.size()), field_(field), bits_(truth.size()) {
    // Few of the pictures' samples are in the caches together: strip by strip.
    forEachStrip([&](std::size_t first, std::size_t end) {
      const auto strip = [&](std::span<const Shade> samples) {
        return samples.subspan(first, end - first);
      };
      setTruth(first, strip(truth.samples), strip(candidates.front()->samples));
      for (std::size_t i = first; i < end; ++i) {
        const bool isIn = selected.empty() || selected[i] != 0;
        bits_[i] = static_cast<Word>(bits_[i] | (isIn ? selectedBit : 0));
      }
      for (std::size_t c = 0; c < count_; ++c) {
        addCandidate(first, strip(candidates[c]->samples), firstCandidateBit + c);
      }
    });
  }

  /// In the order of the samples that they start in.
  [[nodiscard]] Runs find() const {
    std::vector<Runs> strips(stripCount(), Runs(count_));
    forEachStrip([&](std::size_t first, std::size_t end) {
      findFrom(first, end, strips[first / samplesAtOnce]);
    });
    Runs runs(count_);
    const auto append = [](std::vector<double>& all, const std::vector<double>& some) {
      all.insert(all.end(), some.begin(), some.end());
    };
    for (const Runs& strip : strips) append(runs.truth, strip.truth);
    parallelFor(0, count_, [&](std::size_t c) {
      for (const Runs& strip : strips) append(runs.ratios[c], strip.ratios[c]);
    });
    return runs;
  }

 private:
  /// A length of each candidate.
  using Lengths = std::array<double, mostCandidatesIn<Word>>;

  static constexpr std::size_t samplesAtOnce = 1 << 14;
  [[nodiscard]] std::size_t stripCount() const {
    return (bits_.size() + samplesAtOnce - 1) / samplesAtOnce;
  }
  /// Calls `work(first, end)` for all samples, some at a time.
  template <typename Work>
  void forEachStrip(const Work& work) const {
    parallelFor(0, stripCount(), [&](std::size_t strip) {
      const std::size_t first = strip * samplesAtOnce;
      work(first, std::min(first + samplesAtOnce, bits_.size()));
    });
  }

  /// A point of the view: a sample and the place in it, columns and rows.
  struct Start {
    std::size_t sample;
    Vec2 position;
  };

  void setTruth(std::size_t first, std::span<const Shade> truth, std::span<const Shade> any) {
    std::transform(truth.begin(), truth.end(), any.begin(), &bits_[first],
                   [](Shade right, Shade own) {
                     const bool both = isAnswer(right) & isAnswer(own);
                     return static_cast<Word>((right == Shade::shadowed ? darkBit : 0) |
                                              (both ? answersBit : 0));
                   });
  }
  void addCandidate(std::size_t first, std::span<const Shade> samples, std::size_t bit) {
    std::transform(samples.begin(), samples.end(), &bits_[first], &bits_[first],
                   [bit](Shade own, Word bits) {
                     const auto dark = static_cast<Word>(own == Shade::shadowed);
                     return static_cast<Word>(bits | static_cast<Word>(dark << bit));
                   });
  }

  /// That start in some of the samples.
  void findFrom(std::size_t first, std::size_t end, Runs& runs) const {
    for (std::size_t i = first; i < end; ++i) {
      if (!isDark(i) || !has(i, answersBit) || !Walk::hasDirection(field_, i)) continue;
      const Vec2 centre = centreOf(i);
      if (!isBesideLit(i, centre)) continue;
      for (int k = 0; k < linesPerRun; ++k) {
        const Start start{i, centre + lineStart(k)};
        if (isStart(start)) follow(start, runs);
      }
    }
  }

  [[nodiscard]] Walk walkFrom(const Start& start, Walk::Heading heading) const {
    return {field_, start.sample, start.position, heading};
  }

  [[nodiscard]] Vec2 centreOf(std::size_t i) const {
    const auto width = static_cast<std::size_t>(field_.width);
    const std::size_t column = i % width;
    const std::size_t row = i / width;
    return {static_cast<double>(column), static_cast<double>(row)};
  }

  /// Whether a step back from anywhere in a sample may lead into one that the truth lights: few
  /// dark samples lie so, and the others need none of their lines looked at.
  [[nodiscard]] bool isBesideLit(std::size_t i, const Vec2& centre) const {
    const auto width = static_cast<std::size_t>(field_.width);
    // Lines start less than half a sample from the centre.
    const Vec2 first = glm::floor(centre - Vec2(field_.steps[i].away));
    for (const double row : {first.y, first.y + 1}) {
      for (const double column : {first.x, first.x + 1}) {
        const bool isSeen = row >= 0 && column >= 0 && row < field_.height && column < field_.width;
        if (isSeen &&
            !isDark(static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column))) {
          return true;
        }
      }
    }
    return false;
  }

  [[nodiscard]] bool isStart(const Start& start) const {
    Walk back = walkFrom(start, Walk::Heading::toward);
    return goOn(back) && !isDark(back.index());
  }

  /// Adds the run that starts there, unless it is left out.
  void follow(const Start& start, Runs& runs) const {
    Walk walk = walkFrom(start, Walk::Heading::away);
    Lengths lengths{};
    double length = 0;
    std::size_t samples = 0;
    bool isAnySelected = false;
    Candidates whole = all();  // dark in every sample so far: as long as the truth
    Candidates darkAtEnd = 0;
    do {
      darkAtEnd = candidatesAt(walk.index());
      forEach(whole & ~darkAtEnd, [&](std::size_t c) { lengths[c] = length; });
      whole &= darkAtEnd;
      isAnySelected = isAnySelected || has(walk.index(), selectedBit);
      length += walk.length();
      forEach(darkAtEnd & ~whole, [&](std::size_t c) { lengths[c] += walk.length(); });
      ++samples;
      if (!goOn(walk)) return;
    } while (isDark(walk.index()));
    if (samples < leastRunSamples || !isAnySelected || !(length > 0)) return;
    forEach(whole, [&](std::size_t c) { lengths[c] = length; });

    Lengths beyond{};
    if (!addBeyond(walk, darkAtEnd, length, beyond)) return;
    Lengths before{};
    addBefore(start, before);
    runs.truth.push_back(length);
    for (std::size_t c = 0; c < count_; ++c) {
      runs.ratios[c].push_back((lengths[c] + (beyond[c] + before[c])) / length);
    }
  }

  /// What the candidates add after the truth's run; false where the line ends too soon to tell.
  /// @param connected  those whose shadow goes on from the run's end
  bool addBeyond(Walk& walk, Candidates connected, double room, Lengths& beyond) const {
    double seen = 0;
    while (!isDark(walk.index())) {
      const Candidates ended = connected & ~candidatesAt(walk.index());
      forEach(ended, [&](std::size_t c) { beyond[c] = seen; });
      connected &= ~ended;
      seen += walk.length();
      if (connected == 0 && seen >= room) break;
      if (goOn(walk)) continue;
      if (seen < room) return false;
      break;
    }
    forEach(connected, [&](std::size_t c) { beyond[c] = seen; });
    return true;
  }

  /// What they add before its start.
  void addBefore(const Start& start, Lengths& before) const {
    Candidates connected = candidatesAt(start.sample);
    double seen = 0;
    for (Walk walk = walkFrom(start, Walk::Heading::toward); connected != 0 && goOn(walk);) {
      if (isDark(walk.index())) return;
      const Candidates ended = connected & ~candidatesAt(walk.index());
      forEach(ended, [&](std::size_t c) { before[c] = seen; });
      connected &= ~ended;
      seen += walk.length();
    }
    forEach(connected, [&](std::size_t c) { before[c] = seen; });
  }

  [[nodiscard]] Candidates all() const {
    return ~Candidates{0} >> (8 * sizeof(Candidates) - count_);
  }
  [[nodiscard]] bool goOn(Walk& walk) const {
    return walk.advance() && has(walk.index(), answersBit);
  }
  [[nodiscard]] bool has(std::size_t i, unsigned bit) const { return (bits_[i] & bit) != 0; }
  [[nodiscard]] bool isDark(std::size_t i) const { return has(i, darkBit); }
  [[nodiscard]] Candidates candidatesAt(std::size_t i) const {
    return Candidates{bits_[i]} >> firstCandidateBit;
  }

  std::size_t count_;
  const LightField& field_;
  RawVector<Word> bits_;  ///< of each sample
};

Runs runsOf(std::span<const Mask* const> candidates, const Mask& truth, const LightField& field,
            std::span<const std::uint8_t> selected) {
  if (candidates.size() <= mostCandidatesIn<std::uint8_t>) {
    return RunFinder<std::uint8_t>(candidates, truth, field, selected).find();
  }
  if (candidates.size() <= mostCandidatesIn<std::uint16_t>) {
    return RunFinder<std::uint16_t>(candidates, truth, field, selected).find();
  }
  return RunFinder<std::uint64_t>(candidates, truth, field, selected).find();
}

void requireField(const LightField& field, const Mask& truth) {
  if (field.width != truth.width || field.height != truth.height ||
      field.steps.size() != truth.size()) {
    throw InputError(fmt::format("light field: {} x {} with {} steps, but the masks have {} x {}",
                                 field.width, field.height, field.steps.size(), truth.width,
                                 truth.height));
  }
}

}  // namespace

ShadowLengths compareShadowLengths(const Mask& candidate, const Mask& truth,
                                   const LightField& field,
                                   std::span<const std::uint8_t> selected) {
  const std::array<const Mask*, 1> one = {&candidate};
  return compareShadowLengths(one, truth, field, selected).front();
}

std::vector<ShadowLengths> compareShadowLengths(std::span<const Mask* const> candidates,
                                                const Mask& truth, const LightField& field,
                                                std::span<const std::uint8_t> selected) {
  for (const Mask* candidate : candidates) requireSameView(*candidate, truth);
  requireField(field, truth);
  requireOnePerSample(selected.size(), truth.size(), "selection");
  return compareInGroups(candidates, truth, [&](std::span<const Mask* const> group) {
    Runs runs = runsOf(group, truth, field, selected);
    ShadowLengths common;
    common.runs = static_cast<double>(runs.truth.size()) / linesPerRun;
    std::vector<ShadowLengths> found(group.size(), common);
    if (common.runs < leastRuns) return found;
    const double truthLength = takeQuantile(runs.truth, 0.5);
    parallelFor(0, group.size(), [&](std::size_t c) {
      std::vector<double>& ratios = runs.ratios[c];
      found[c].ratio = takeQuantile(ratios, 0.5);
      found[c].lowerQuartile = takeQuantile(ratios, 0.25);
      found[c].upperQuartile = takeQuantile(ratios, 0.75);
      found[c].truthLength = truthLength;
    });
    return found;
  });
}

std::vector<Metric> lengthMetrics(const ShadowLengths& lengths) {
  static_assert(leastRuns == 30, "the reason names it");
  static const std::vector<MetricId> ids = metricsOfKinds({MetricKind::length});
  const auto metric = [&](std::size_t i, std::optional<double> value) -> Metric {
    if (value) return {ids[i], value, {}};
    return {ids[i],
            {},
            lengths.runs == 0 ? "no cast shadow with both ends in view"
                              : "fewer than 30 cast shadows with both ends in view"};
  };
  return {metric(0, lengths.ratio), metric(1, lengths.lowerQuartile),
          metric(2, lengths.upperQuartile), metric(3, lengths.runs)};
}

}  // namespace gnomon::compare
