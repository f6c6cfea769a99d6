#include "compare/block_bootstrap.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "common/error.h"
#include "compare/counts.h"
#include "compare/mask_checks.h"
#include "compare/resampling.h"

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
  std::size_t i = 0;
  for (int y = 0; y < truth.height; ++y) {
    const auto firstOfRow = static_cast<std::size_t>(y / side) * static_cast<std::size_t>(columns);
    for (int column = 0; column < columns; ++column) {
      const std::size_t block = firstOfRow + static_cast<std::size_t>(column);
      const int end = std::min(truth.width, (column + 1) * side);
      for (int x = column * side; x < end; ++x, ++i) {
        if (mask.samples[i] == Shade::none || truth.samples[i] == Shade::none) continue;
        const double weight = weights.empty() ? 1 : weights[i];
        errors.weight[block] += weight;
        const bool counts = selected.empty() || selected[i] != 0;
        if (counts && mask.samples[i] != truth.samples[i]) errors.wrong[block] += weight;
      }
    }
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
