#include "compare/block_bootstrap.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "common/error.h"
#include "compare/counts.h"
#include "compare/mask_checks.h"

namespace gnomon {
namespace {

double sumOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

void requireSameBlocks(const BlockErrors& a, const BlockErrors& b) {
  if (a.wrong.size() != b.wrong.size() || a.wrong.size() != a.weight.size() ||
      b.wrong.size() != b.weight.size()) {
    throw InternalError(
        fmt::format("{} and {} blocks found, as many expected", a.wrong.size(), b.wrong.size()));
  }
}

/// Whole numbers below a bound, each as likely: the library's own distributions differ between
/// systems.
class Draws {
 public:
  Draws(std::uint64_t seed, std::size_t bound)
      : bound_(bound),
        last_(std::numeric_limits<std::uint64_t>::max() -
              std::numeric_limits<std::uint64_t>::max() % bound_ - 1),
        generator_(seed) {}

  std::size_t next() {
    std::uint64_t number = generator_();
    while (number > last_) number = generator_();
    return static_cast<std::size_t>(number % bound_);
  }

 private:
  std::uint64_t bound_;
  std::uint64_t last_;  ///< the last number of the last whole run of `bound_`
  std::mt19937_64 generator_;
};

/// Linear between the two nearest of the sorted values.
double percentile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double part = place - static_cast<double>(below);
  return sorted[below] + part * (sorted[above] - sorted[below]);
}

double ratio(double wrong, double weight) {
  return weight > 0 ? wrong / weight : 0;
}

/// Wrong and all weight of one resample.
struct Sums {
  double wrong = 0;
  double weight = 0;

  void add(const BlockErrors& errors, std::size_t block) {
    wrong += errors.wrong[block];
    weight += errors.weight[block];
  }
  [[nodiscard]] double rate() const { return ratio(wrong, weight); }
};

}  // namespace

double BlockErrors::rate() const {
  return ratio(sumOf(wrong), sumOf(weight));
}

std::size_t BlockErrors::count() const {
  return static_cast<std::size_t>(
      std::count_if(weight.begin(), weight.end(), [](double w) { return w > 0; }));
}

BlockErrors& BlockErrors::operator+=(const BlockErrors& other) {
  requireSameBlocks(*this, other);
  std::transform(wrong.begin(), wrong.end(), other.wrong.begin(), wrong.begin(), std::plus<>());
  std::transform(weight.begin(), weight.end(), other.weight.begin(), weight.begin(), std::plus<>());
  return *this;
}

BlockErrors blockErrors(const Mask& mask, const Mask& truth, int side,
                        std::span<const double> weights, std::span<const std::uint8_t> selected) {
  if (side < 1) throw InternalError(fmt::format("block side {} found, 1 or more expected", side));
  // The same checks of the input, in one place.
  (void)countSamples(mask, truth, weights);
  requireOnePerSample(selected.size(), truth.size(), "selection");
  const int columns = (truth.width + side - 1) / side;
  const int rows = (truth.height + side - 1) / side;
  const auto blocks = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  BlockErrors errors{std::vector<double>(blocks), std::vector<double>(blocks)};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (mask.samples[i] == Shade::none || truth.samples[i] == Shade::none) continue;
    const auto width = static_cast<std::size_t>(truth.width);
    const auto step = static_cast<std::size_t>(side);
    const std::size_t block =
        i / width / step * static_cast<std::size_t>(columns) + i % width / step;
    const double weight = weights.empty() ? 1 : weights[i];
    errors.weight[block] += weight;
    const bool counts = selected.empty() || selected[i] != 0;
    if (counts && mask.samples[i] != truth.samples[i]) errors.wrong[block] += weight;
  }
  return errors;
}

Interval differenceInterval(const BlockErrors& before, const BlockErrors& after,
                            const BootstrapSettings& settings) {
  requireSameBlocks(before, after);
  if (settings.resamples < 1 || !(settings.confidence > 0 && settings.confidence < 1)) {
    throw InternalError(fmt::format("{} resamples and confidence {} found", settings.resamples,
                                    settings.confidence));
  }
  std::vector<std::size_t> held;
  for (std::size_t i = 0; i < before.weight.size(); ++i) {
    if (before.weight[i] > 0 || after.weight[i] > 0) held.push_back(i);
  }
  if (held.size() < 2) {
    throw InternalError(
        fmt::format("{} blocks with a sample found, at least 2 expected", held.size()));
  }
  Draws draws(settings.seed, held.size());
  std::vector<double> differences;
  for (int r = 0; r < settings.resamples; ++r) {
    Sums first;
    Sums second;
    for (std::size_t k = 0; k < held.size(); ++k) {
      const std::size_t block = held[draws.next()];
      first.add(before, block);
      second.add(after, block);
    }
    differences.push_back(first.rate() - second.rate());
  }
  std::sort(differences.begin(), differences.end());
  const double tail = (1 - settings.confidence) / 2;
  return {percentile(differences, tail), percentile(differences, 1 - tail)};
}

Interval rateInterval(const BlockErrors& errors, const BootstrapSettings& settings) {
  const BlockErrors none{std::vector<double>(errors.wrong.size()), errors.weight};
  return differenceInterval(errors, none, settings);
}

}  // namespace gnomon
