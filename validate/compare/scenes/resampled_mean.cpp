#include "compare/scenes/resampled_mean.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "common/error.h"
#include "common/random_stream.h"

namespace gnomon::compare {
namespace {

/// Shares of resamples are compared with levels such as 0.05 / 190: what rounding makes of both
/// must not decide.
constexpr double rounding = 1e-9;

/// How many sets of values a pass over the resamples takes: what the registers of any processor
/// hold.
constexpr std::size_t lanes = 8;

/// Of one scene: by how much it deviates from the mean of each set, and the squares.
struct SceneDeviations {
  std::array<double, lanes> values = {};
  std::array<double, lanes> squares = {};
};

/// t* of one resample.
/// @param sum, squares  of the deviations of the n values drawn
double deviateOf(double sum, double squares, double n) {
  const double variance = (squares - sum * sum / n) / (n - 1);
  // What cancellation leaves of values that are all the same.
  if (!(variance > 1e-12 * squares)) return sum == 0 ? 0 : std::numeric_limits<double>::infinity();
  return std::abs(sum) / std::sqrt(n * variance);
}

/// The t* of the first so many sets, `deviates[set][resample]`.
std::vector<std::vector<double>> deviatesOf(const std::vector<SceneDeviations>& scenes,
                                            std::size_t sets, const SceneResamples& resamples) {
  std::vector<std::vector<double>> deviates(sets, std::vector<double>(resamples.count()));
  const auto n = static_cast<double>(scenes.size());
  std::vector<std::uint32_t> drawn(scenes.size());
  for (std::size_t b = 0; b < resamples.count(); ++b) {
    resamples.draw(b, drawn);
    SceneDeviations sums;
    for (const std::uint32_t s : drawn) {
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        sums.values[lane] += scenes[s].values[lane];
        sums.squares[lane] += scenes[s].squares[lane];
      }
    }
    for (std::size_t set = 0; set < sets; ++set) {
      deviates[set][b] = deviateOf(sums.values[set], sums.squares[set], n);
    }
  }
  return deviates;
}

/// At which place of all t*, falling from 1, an interval of an error ends; 0 where the resamples
/// are too few to tell so small an error.
std::size_t placeOf(double error, std::size_t resamples) {
  return static_cast<std::size_t>(error * (1 + static_cast<double>(resamples)) + rounding);
}

/// The places of the errors largestError / k, k = 1, 2, …, falling: some 2 √(largestError B).
std::vector<std::size_t> placesOf(std::size_t resamples) {
  std::vector<std::size_t> places;
  for (double k = 1;; ++k) {
    const std::size_t place = placeOf(ResampledMean::largestError / k, resamples);
    if (place == 0) return places;
    if (places.empty() || place < places.back()) places.push_back(place);
  }
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

ResampledMean::ResampledMean(std::span<const double> values, std::size_t resamples)
    : resamples_(resamples) {
  const auto n = static_cast<double>(values.size());
  mean_ = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() < leastScenes) {
    reason_ = "fewer than 20 scenes";
    return;
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (*least == *most) {
    reason_ = "every scene gives the same";
    return;
  }
  double squares = 0;
  for (const double value : values) squares += (value - mean_) * (value - mean_);
  standardError_ = std::sqrt(squares / (n - 1) / n);
}

ResampledMean::ResampledMean(std::span<const double> values, const SceneResamples& resamples)
    : ResampledMean(ofAll(std::array{std::vector(values.begin(), values.end())}, resamples)[0]) {}

std::vector<ResampledMean> ResampledMean::ofAll(std::span<const std::vector<double>> sets,
                                                const SceneResamples& resamples) {
  std::vector<ResampledMean> means;
  for (const std::vector<double>& values : sets) {
    if (values.size() != resamples.scenes()) {
      throw InternalError(
          fmt::format("{} values found, {} scenes expected", values.size(), resamples.scenes()));
    }
    means.push_back(ResampledMean(values, resamples.count()));
  }
  const std::vector<std::size_t> places = placesOf(resamples.count());
  for (std::size_t first = 0; first < sets.size(); first += lanes) {
    const std::size_t count = std::min(lanes, sets.size() - first);
    std::vector<SceneDeviations> scenes(resamples.scenes());
    bool isAny = false;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const ResampledMean& mean = means[first + lane];
      if (!mean.reason_.empty()) continue;
      isAny = true;
      for (std::size_t s = 0; s < scenes.size(); ++s) {
        const double deviation = sets[first + lane][s] - mean.mean_;
        scenes[s].values[lane] = deviation;
        scenes[s].squares[lane] = deviation * deviation;
      }
    }
    if (!isAny) continue;
    std::vector<std::vector<double>> deviates = deviatesOf(scenes, count, resamples);
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (means[first + lane].reason_.empty())
        means[first + lane].setDeviates(deviates[lane], places);
    }
  }
  return means;
}

void ResampledMean::setDeviates(std::vector<double>& all, const std::vector<std::size_t>& places) {
  const double found = std::abs(mean_) / standardError_;
  const auto reached = std::count_if(all.begin(), all.end(), [&](double t) { return t >= found; });
  probabilityOfZero_ = (1 + static_cast<double>(reached)) / (1 + static_cast<double>(resamples_));
  if (places.empty()) return;
  const auto kept = all.begin() + static_cast<std::ptrdiff_t>(places.front());
  std::nth_element(all.begin(), kept - 1, all.end(), std::greater<>());
  std::sort(all.begin(), kept, std::greater<>());
  largest_.reserve(places.size());
  for (const std::size_t place : places) largest_.push_back({place, all[place - 1]});
}

std::optional<Interval> ResampledMean::interval(double error) const {
  const std::size_t place = placeOf(error, resamples_);
  if (!reason_.empty() || place < 1) return std::nullopt;
  const auto found = std::find_if(largest_.begin(), largest_.end(),
                                  [&](const Deviate& deviate) { return deviate.place == place; });
  if (found == largest_.end()) {
    throw InternalError(
        fmt::format("an error of {} found, {} over a whole number expected", error, largestError));
  }
  const double half = found->value * standardError_;
  if (!std::isfinite(half)) return std::nullopt;
  return Interval{mean_ - half, mean_ + half};
}

std::optional<BinnedError> binnedError(std::span<const SceneShare> shares,
                                       const SceneResamples& resamples) {
  BinnedError bin;
  double wrong = 0;
  for (const SceneShare& share : shares) {
    bin.scenes += share.weight > 0 ? 1 : 0;
    bin.weight += share.weight;
    wrong += share.wrong;
  }
  if (bin.scenes == 0) return std::nullopt;
  bin.errorRate = wrong / bin.weight;
  bin.weight /= static_cast<double>(shares.size());
  if (bin.scenes < leastBinScenes) return bin;
  std::vector<double> residuals;
  residuals.reserve(shares.size());
  for (const SceneShare& share : shares) {
    residuals.push_back((share.wrong - bin.errorRate * share.weight) / bin.weight);
  }
  const auto around = ResampledMean(residuals, resamples).interval(0.05);
  if (!around) return bin;
  bin.interval = Interval{std::max(0.0, bin.errorRate + around->low),
                          std::min(1.0, bin.errorRate + around->high)};
  return bin;
}

}  // namespace gnomon::compare
