#include "compare/block_errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "common/error.h"
#include "compare/answer_pair.h"
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

/// A step of FNV-1, by words: of two equal numbers it is not 0, as FNV-1a's is.
std::uint64_t hashed(std::uint64_t hash, std::uint64_t word) {
  return (hash * 1099511628211ULL) ^ word;
}

template <typename Pair>
BlockErrors errorsOf(const Pair& pair, int side, std::span<const double> weights,
                     std::span<const std::uint8_t> selected) {
  requireOnePerSample(selected.size(), pair.size(), "selection");
  const int columns = (pair.width() + side - 1) / side;
  const int rows = (pair.height() + side - 1) / side;
  const auto blocks = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  BlockErrors errors{std::vector<double>(blocks), std::vector<double>(blocks),
                     14695981039346656037ULL};
  std::size_t i = 0;
  for (int y = 0; y < pair.height(); ++y) {
    const auto firstOfRow = static_cast<std::size_t>(y / side) * static_cast<std::size_t>(columns);
    for (int column = 0; column < columns; ++column) {
      const std::size_t block = firstOfRow + static_cast<std::size_t>(column);
      const int end = std::min(pair.width(), (column + 1) * side);
      for (int x = column * side; x < end; ++x, ++i) {
        errors.answers = hashed(errors.answers, pair.answerBits(i));
        if (!pair.hasBoth(i)) continue;
        const double weight = weights.empty() ? 1 : weights[i];
        errors.weight[block] += weight;
        const bool counts = selected.empty() || selected[i] != 0;
        if (counts) errors.wrong[block] += weight * pair.wrong(i);
      }
    }
  }
  return errors;
}

void requireSide(int side) {
  if (side < 1) throw InternalError(fmt::format("block side {} found, 1 or more expected", side));
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
  answers = answers == 0 || other.answers == 0 ? 0 : hashed(answers, other.answers);
  return *this;
}

BlockErrors blockErrors(const Mask& mask, const Mask& truth, int side,
                        std::span<const double> weights, std::span<const std::uint8_t> selected) {
  requireSide(side);
  (void)countSamples(mask, truth, weights);  // the same checks of the input, in one place
  return errorsOf(MaskPair(mask, truth), side, weights, selected);
}

BlockErrors blockErrors(const Visibility& map, const Visibility& truth, int side,
                        std::span<const double> weights, std::span<const std::uint8_t> selected) {
  requireSide(side);
  (void)countSamples(map, truth, weights);  // the same checks of the input, in one place
  return errorsOf(SharePair(map, truth), side, weights, selected);
}

}  // namespace gnomon::compare
