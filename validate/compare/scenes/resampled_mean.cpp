#include "compare/scenes/resampled_mean.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "common/counted_random.h"
#include "common/error.h"

namespace gnomon::compare {
namespace {

/// Shares of resamples are compared with levels such as 0.05 / 190: what rounding makes of both
/// must not decide.
constexpr double rounding = 1e-9;

/// t* of one resample.
/// @param deviations  of the values from their mean
double deviationOf(std::span<const std::uint32_t> draws, const std::vector<double>& deviations) {
  double sum = 0;
  double squares = 0;
  for (const std::uint32_t s : draws) {
    sum += deviations[s];
    squares += deviations[s] * deviations[s];
  }
  const auto n = static_cast<double>(draws.size());
  const double variance = (squares - sum * sum / n) / (n - 1);
  // What cancellation leaves of values that are all the same.
  if (!(variance > 1e-12 * squares)) return sum == 0 ? 0 : std::numeric_limits<double>::infinity();
  return std::abs(sum) / std::sqrt(n * variance);
}

}  // namespace

std::size_t resamplesFor(std::size_t comparisons) {
  return std::max(standardResamples, 40 * std::max<std::size_t>(comparisons, 1) - 1);
}

SceneResamples::SceneResamples(std::size_t scenes, std::size_t resamples)
    : scenes_(scenes), count_(resamples) {
  if (scenes == 0) throw InternalError("no scene found to draw from, 1 or more expected");
}

void SceneResamples::draw(std::size_t resample, std::span<std::uint32_t> scenes) const {
  const std::uint64_t first = std::uint64_t{resample} * scenes_;
  const auto count = static_cast<double>(scenes_);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    scenes[k] = static_cast<std::uint32_t>(randomUnit(0, "scenes", first + k) * count);
  }
}

ResampledMean::ResampledMean(std::span<const double> values, const SceneResamples& resamples)
    : resamples_(resamples.count()) {
  if (values.size() != resamples.scenes()) {
    throw InternalError(
        fmt::format("{} values found, {} scenes expected", values.size(), resamples.scenes()));
  }
  const auto n = static_cast<double>(values.size());
  mean_ = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() < leastScenes) {
    reason_ = "fewer than 20 scenes";
    return;
  }
  std::vector<double> deviations;
  double squares = 0;
  for (const double value : values) {
    deviations.push_back(value - mean_);
    squares += deviations.back() * deviations.back();
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (*least == *most) {
    reason_ = "every scene gives the same";
    return;
  }
  standardError_ = std::sqrt(squares / (n - 1) / n);
  std::vector<double> all;
  all.reserve(resamples_);
  std::vector<std::uint32_t> drawn(values.size());
  for (std::size_t b = 0; b < resamples_; ++b) {
    resamples.draw(b, drawn);
    all.push_back(deviationOf(drawn, deviations));
  }
  const double found = std::abs(mean_) / standardError_;
  const auto reached = std::count_if(all.begin(), all.end(), [&](double t) { return t >= found; });
  probabilityOfZero_ = (1 + static_cast<double>(reached)) / (1 + static_cast<double>(resamples_));
  const auto kept = static_cast<std::ptrdiff_t>(largestError * static_cast<double>(resamples_) + 2);
  largest_.resize(static_cast<std::size_t>(std::min(kept, std::ssize(all))));
  std::partial_sort_copy(all.begin(), all.end(), largest_.begin(), largest_.end(),
                         std::greater<>());
}

std::optional<Interval> ResampledMean::interval(double error) const {
  if (error > largestError + rounding) {
    throw InternalError(
        fmt::format("an error of {} found, {} or less expected", error, largestError));
  }
  const auto place =
      static_cast<std::size_t>(error * (1 + static_cast<double>(resamples_)) + rounding);
  if (!reason_.empty() || place < 1 || place > largest_.size()) return std::nullopt;
  const double half = largest_[place - 1] * standardError_;
  if (!std::isfinite(half)) return std::nullopt;
  return Interval{mean_ - half, mean_ + half};
}

}  // namespace gnomon::compare
