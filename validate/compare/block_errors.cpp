#include "compare/block_errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "common/error.h"
#include "compare/counts.h"
#include "compare/mask_checks.h"

namespace gnomon::compare {
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

}  // namespace

double BlockErrors::rate() const {
  const double all = sumOf(weight);
  return all > 0 ? sumOf(wrong) / all : 0;
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

}  // namespace gnomon::compare
