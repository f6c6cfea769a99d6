#include "compare/shadow_length.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.h"
#include "common/parallel.h"
#include "common/quantile.h"
#include "common/vec.h"
#include "compare/mask_checks.h"

namespace gnomon {
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

  /// @param within  of the sample's centre, columns and rows
  Walk(const LightField& field, std::size_t start, Vec2 within, Heading heading)
      : field_(field), sign_(static_cast<int>(heading)), index_(start) {
    const auto width = static_cast<std::size_t>(field.width);
    const std::size_t column = start % width;
    const std::size_t row = start / width;
    position_ = Vec2(static_cast<double>(column), static_cast<double>(row)) + within;
  }

  [[nodiscard]] std::size_t index() const { return index_; }
  [[nodiscard]] double length() const { return field_.steps[index_].length; }

  /// Goes on by one step; false where it cannot.
  [[nodiscard]] bool advance() {
    if (++taken_ > 4 * (field_.width + field_.height)) return false;  // a field that leads in rings
    const Vec2 next = position_ + sign_ * Vec2(field_.steps[index_].away);
    const Vec2 nearest = glm::floor(next + 0.5);
    if (!(nearest.x >= 0 && nearest.y >= 0 && nearest.x < field_.width &&
          nearest.y < field_.height)) {
      return false;
    }
    const auto there =
        static_cast<std::size_t>(nearest.y) * static_cast<std::size_t>(field_.width) +
        static_cast<std::size_t>(nearest.x);
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

/// One shadow on one line.
struct Run {
  double truth = 0;
  double candidate = 0;
};

class RunFinder {
 public:
  RunFinder(const Mask& candidate, const Mask& truth, const LightField& field,
            std::span<const std::uint8_t> selected)
      : candidate_(candidate), truth_(truth), field_(field), selected_(selected) {}

  /// In the order of the samples that they start in.
  [[nodiscard]] std::vector<Run> find() const {
    constexpr std::size_t samplesAtOnce = 1 << 14;
    std::vector<std::vector<Run>> strips((truth_.size() + samplesAtOnce - 1) / samplesAtOnce);
    parallelFor(0, strips.size(), [&](std::size_t strip) {
      const std::size_t first = strip * samplesAtOnce;
      strips[strip] = findFrom(first, std::min(first + samplesAtOnce, truth_.size()));
    });
    std::vector<Run> runs;
    for (const auto& strip : strips) runs.insert(runs.end(), strip.begin(), strip.end());
    return runs;
  }

 private:
  /// A point of the view: a sample and the place in it, from its centre.
  struct Start {
    std::size_t sample;
    Vec2 within;
  };

  /// That start in some of the samples.
  [[nodiscard]] std::vector<Run> findFrom(std::size_t first, std::size_t end) const {
    std::vector<Run> runs;
    for (std::size_t i = first; i < end; ++i) {
      if (!isDark(truth_, i) || !hasAnswers(i) || !Walk::hasDirection(field_, i)) continue;
      if (!isBesideLit(i)) continue;
      for (int k = 0; k < linesPerRun; ++k) {
        const Start start{i, lineStart(k)};
        if (!isStart(start)) continue;
        if (const auto run = follow(start)) runs.push_back(*run);
      }
    }
    return runs;
  }

  [[nodiscard]] Walk walkFrom(const Start& start, Walk::Heading heading) const {
    return {field_, start.sample, start.within, heading};
  }

  /// Whether a step back from anywhere in a sample may lead into one that the truth lights: few
  /// dark samples lie so, and the others need none of their lines looked at.
  [[nodiscard]] bool isBesideLit(std::size_t i) const {
    const auto width = static_cast<std::size_t>(field_.width);
    const std::size_t sampleColumn = i % width;
    const std::size_t sampleRow = i / width;
    const Vec2 centre(static_cast<double>(sampleColumn), static_cast<double>(sampleRow));
    // Lines start less than half a sample from the centre.
    const Vec2 first = glm::floor(centre - Vec2(field_.steps[i].away));
    for (const double row : {first.y, first.y + 1}) {
      for (const double column : {first.x, first.x + 1}) {
        const bool isSeen = row >= 0 && column >= 0 && row < field_.height && column < field_.width;
        if (isSeen && !isDark(truth_, static_cast<std::size_t>(row) * width +
                                          static_cast<std::size_t>(column))) {
          return true;
        }
      }
    }
    return false;
  }

  [[nodiscard]] bool isStart(const Start& start) const {
    Walk back = walkFrom(start, Walk::Heading::toward);
    return goOn(back) && !isDark(truth_, back.index());
  }

  [[nodiscard]] std::optional<Run> follow(const Start& start) const {
    Walk walk = walkFrom(start, Walk::Heading::away);
    Run run;
    std::size_t samples = 0;
    bool isSelected = false;
    bool darkAtEnd = false;
    do {
      darkAtEnd = isDark(candidate_, walk.index());
      isSelected = isSelected || selected_.empty() || selected_[walk.index()] != 0;
      run.truth += walk.length();
      if (darkAtEnd) run.candidate += walk.length();
      ++samples;
      if (!goOn(walk)) return std::nullopt;
    } while (isDark(truth_, walk.index()));
    if (samples < leastRunSamples || !isSelected || !(run.truth > 0)) return std::nullopt;

    const auto beyond = lengthBeyond(walk, darkAtEnd, run.truth);
    if (!beyond) return std::nullopt;
    run.candidate += *beyond + lengthBefore(start);
    return run;
  }

  /// What the candidate adds after the truth's run; nothing to tell where the line ends too soon.
  [[nodiscard]] std::optional<double> lengthBeyond(Walk& walk, bool isConnected,
                                                   double room) const {
    double seen = 0;
    double beyond = 0;
    while (!isDark(truth_, walk.index())) {
      isConnected = isConnected && isDark(candidate_, walk.index());
      seen += walk.length();
      if (isConnected) beyond += walk.length();
      if (!isConnected && seen >= room) break;
      if (goOn(walk)) continue;
      if (seen < room) return std::nullopt;
      break;
    }
    return beyond;
  }

  [[nodiscard]] double lengthBefore(const Start& start) const {
    if (!isDark(candidate_, start.sample)) return 0;
    double before = 0;
    for (Walk walk = walkFrom(start, Walk::Heading::toward); goOn(walk);) {
      if (isDark(truth_, walk.index())) return 0;
      if (!isDark(candidate_, walk.index())) break;
      before += walk.length();
    }
    return before;
  }

  [[nodiscard]] bool goOn(Walk& walk) const { return walk.advance() && hasAnswers(walk.index()); }
  [[nodiscard]] bool hasAnswers(std::size_t i) const {
    return isAnswer(candidate_.samples[i]) && isAnswer(truth_.samples[i]);
  }
  [[nodiscard]] static bool isDark(const Mask& mask, std::size_t i) {
    return mask.samples[i] == Shade::shadowed;
  }

  const Mask& candidate_;
  const Mask& truth_;
  const LightField& field_;
  std::span<const std::uint8_t> selected_;
};

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
  requireSameView(candidate, truth);
  requireField(field, truth);
  requireOnePerSample(selected.size(), truth.size(), "selection");

  std::vector<double> ratios;
  std::vector<double> lengths;
  for (const Run& run : RunFinder(candidate, truth, field, selected).find()) {
    ratios.push_back(run.candidate / run.truth);
    lengths.push_back(run.truth);
  }
  ShadowLengths found;
  found.runs = static_cast<double>(ratios.size()) / linesPerRun;
  if (found.runs < leastRuns) return found;
  std::sort(ratios.begin(), ratios.end());
  std::sort(lengths.begin(), lengths.end());
  found.ratio = quantile(ratios, 0.5);
  found.lowerQuartile = quantile(ratios, 0.25);
  found.upperQuartile = quantile(ratios, 0.75);
  found.truthLength = quantile(lengths, 0.5);
  return found;
}

std::vector<Metric> lengthMetrics(const ShadowLengths& lengths) {
  static_assert(leastRuns == 30, "the reason names it");
  const auto& names = lengthMetricNames();
  const auto metric = [&](std::size_t i, std::optional<double> value) -> Metric {
    if (value) return {names[i], value, {}};
    return {names[i],
            {},
            lengths.runs == 0 ? "no cast shadow with both ends in view"
                              : "fewer than 30 cast shadows with both ends in view"};
  };
  return {metric(0, lengths.ratio), metric(1, lengths.lowerQuartile),
          metric(2, lengths.upperQuartile), metric(3, lengths.runs)};
}

const std::vector<std::string_view>& lengthMetricNames() {
  static const std::vector<std::string_view> names = {"shadow_length_ratio", "shadow_length_q1",
                                                      "shadow_length_q3", "shadow_runs"};
  return names;
}

}  // namespace gnomon
