#include "compare/confidence_interval.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "common/error.h"
#include "common/random_stream.h"
#include "compare/answer_metrics.h"
#include "compare/answer_pair.h"
#include "compare/counts.h"

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

namespace {

double ratio(double part, double whole) {
  return whole > 0 ? part / whole : 0;
}

/// One block of both answers.
struct PairedBlock {
  double firstWrong = 0;
  double firstWeight = 0;
  double secondWrong = 0;
  double secondWeight = 0;

  [[nodiscard]] bool isFilled() const { return firstWeight > 0 || secondWeight > 0; }
  [[nodiscard]] bool isShared() const { return firstWeight > 0 && secondWeight > 0; }
  /// r of the header.
  [[nodiscard]] double difference() const {
    return ratio(firstWrong, firstWeight) - ratio(secondWrong, secondWeight);
  }
};

/// Blocks by their place in the view, row by row.
struct BlockGrid {
  std::size_t columns = 0;
  std::vector<PairedBlock> blocks;

  [[nodiscard]] std::size_t rows() const { return blocks.size() / columns; }
  [[nodiscard]] std::size_t filled() const {
    return static_cast<std::size_t>(
        std::count_if(blocks.begin(), blocks.end(), [](const auto& b) { return b.isFilled(); }));
  }
};

/// Blocks of `merged` × `merged` cells.
BlockGrid blocksOf(const BlockErrors& first, const BlockErrors& second, int columns, int merged) {
  const auto width = static_cast<std::size_t>(columns);
  const auto step = static_cast<std::size_t>(merged);
  BlockGrid grid;
  grid.columns = (width + step - 1) / step;
  grid.blocks.resize(grid.columns * ((first.wrong.size() / width + step - 1) / step));
  for (std::size_t i = 0; i < first.wrong.size(); ++i) {
    PairedBlock& block = grid.blocks[i / width / step * grid.columns + i % width / step];
    block.firstWrong += first.wrong[i];
    block.firstWeight += first.weight[i];
    block.secondWrong += second.wrong[i];
    block.secondWeight += second.weight[i];
  }
  return grid;
}

/// How much a view's rate varies, and how well that is known.
struct Spread {
  double standardError = 0;
  double degrees = 0;
};

/// p of the header: each block's share of the view's weight, mean of both answers'; 0 for blocks
/// that one of them lacks, and for slivers of less than a tenth of the mean block.
std::vector<double> sharesOf(const BlockGrid& grid) {
  PairedBlock sum;
  for (const PairedBlock& block : grid.blocks) {
    sum.firstWeight += block.firstWeight;
    sum.secondWeight += block.secondWeight;
  }
  const double least = 0.1 / static_cast<double>(std::max<std::size_t>(1, grid.filled()));
  std::vector<double> shares;
  for (const PairedBlock& block : grid.blocks) {
    const double share =
        (ratio(block.firstWeight, sum.firstWeight) + ratio(block.secondWeight, sum.secondWeight)) /
        2;
    shares.push_back(block.isShared() && share >= least ? share : 0);
  }
  return shares;
}

Spread spreadOf(const BlockGrid& grid) {
  const std::vector<double> shares = sharesOf(grid);
  double weight = 0;
  double sum = 0;      // Σ T
  double squares = 0;  // Σ T²
  for (std::size_t y = 0; y + 1 < grid.rows(); ++y) {
    for (std::size_t x = 0; x + 1 < grid.columns; ++x) {
      const std::size_t corner = y * grid.columns + x;
      const std::array<std::size_t, 4> four = {corner, corner + 1, corner + grid.columns,
                                               corner + grid.columns + 1};
      constexpr std::array<double, 4> signs = {1, -1, -1, 1};
      if (std::any_of(four.begin(), four.end(), [&](std::size_t k) { return shares[k] == 0; })) {
        continue;
      }
      double contrast = 0;
      double inverse = 0;
      double share = 0;
      for (std::size_t k = 0; k < four.size(); ++k) {
        contrast += signs[k] * grid.blocks[four[k]].difference();
        inverse += 1 / shares[four[k]];
        share += shares[four[k]];
      }
      const double part = contrast * contrast / inverse * share;
      weight += share;
      sum += part;
      squares += part * part;
    }
  }
  return {std::sqrt(ratio(sum, weight)), ratio(sum * sum, 2 * squares)};
}

/// By what the spread from blocks is multiplied for what they share.
/// @param halved  the spread from blocks of half the side
double correctionOf(double spread, double halved) {
  return spread > 0 ? std::clamp(2 - halved / spread, 1.0, largestCorrection) : 1;
}

/// s of the header, with the degrees of freedom of the whole blocks.
Spread correctedSpread(const BlockGrid& blocks, const BlockGrid& cells) {
  Spread spread = spreadOf(blocks);
  const double halved = spreadOf(cells).standardError;
  spread.standardError *= correctionOf(spread.standardError, halved);
  return spread;
}

void requireCells(const BlockErrors& first, const BlockErrors& second, const Tiling& tiling) {
  const std::size_t cells = first.wrong.size();
  const bool fills = tiling.columns > 0 && cells % static_cast<std::size_t>(tiling.columns) == 0;
  if (fills && first.weight.size() == cells && second.wrong.size() == cells &&
      second.weight.size() == cells) {
    return;
  }
  throw InternalError(fmt::format("{} and {} cells in {} columns found, the same of both expected",
                                  cells, second.wrong.size(), tiling.columns));
}

/// (Σ w)² / Σ w² of the weights of square blocks; 0 without any.
double effectiveBlocks(const Mask& view, std::span<const double> weights, int side) {
  const int columns = (view.width + side - 1) / side;
  std::vector<double> row(static_cast<std::size_t>(columns));
  double sum = 0;
  double squares = 0;
  std::size_t i = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x, ++i) {
      if (view.samples[i] == Shade::none) continue;
      row[static_cast<std::size_t>(x / side)] += weights.empty() ? 1 : weights[i];
    }
    if ((y + 1) % side != 0 && y + 1 != view.height) continue;
    for (double& weight : row) {
      sum += weight;
      squares += weight * weight;
      weight = 0;
    }
  }
  return ratio(sum * sum, squares);
}

/// By Student's t, of the differences between neighbouring blocks.
/// @param least, most  of what the interval is of
ConfidenceInterval intervalOf(const BlockErrors& first, const BlockErrors& second,
                              const Tiling& tiling, double least, double most) {
  requireCells(first, second, tiling);
  const BlockGrid blocks = blocksOf(first, second, tiling.columns, 2);
  const std::size_t filled = blocks.filled();
  if (filled < leastBlocks) return {{}, "the view has too few blocks of samples", filled};
  const auto differing =
      std::count_if(blocks.blocks.begin(), blocks.blocks.end(),
                    [](const PairedBlock& block) { return block.firstWrong != block.secondWrong; });
  if (differing == 0) return {{}, "no block of the view holds an error", filled};
  if (differing < static_cast<std::ptrdiff_t>(leastWrongBlocks)) {
    return {{}, "too few blocks of the view hold an error", filled};
  }
  const Spread spread = correctedSpread(blocks, blocksOf(first, second, tiling.columns, 1));
  if (!(spread.standardError > 0)) return {{}, "every block of the view gives the same", filled};
  if (spread.degrees < leastDegrees) {
    return {{}, "a few blocks of the view hold nearly all errors", filled};
  }
  const double centre = first.rate() - second.rate();
  const double half = studentQuantile(spread.degrees) * spread.standardError;
  return {Interval{std::max(least, centre - half), std::min(most, centre + half)}, {}, filled};
}

/// x of the header, of the blocks in which it is not 0.
std::vector<double> partsOf(const BlockGrid& grid, double firstWeight, double secondWeight) {
  std::vector<double> parts;
  for (const PairedBlock& block : grid.blocks) {
    const double part =
        ratio(block.firstWrong, firstWeight) - ratio(block.secondWrong, secondWeight);
    if (part != 0) parts.push_back(part);
  }
  return parts;
}

double rootSumOfSquares(const std::vector<double>& values) {
  return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0));
}

/// h of the header, without its correction.
double halfOfFlips(const std::vector<double>& parts) {
  constexpr std::size_t choices = 1999;
  constexpr std::uint64_t stream = splitMix64(textHash("signs"));
  std::vector<double> sums(choices);
  std::uint64_t place = 0;
  for (double& sum : sums) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < parts.size(); ++k, bits >>= 1U) {
      if (k % 64 == 0) bits = splitMix64(stream ^ place++);
      sum += (bits & 1U) != 0 ? parts[k] : -parts[k];
    }
    sum = std::abs(sum);
  }
  const auto twentieth = sums.begin() + (choices + 1) / 20 - 1;
  std::nth_element(sums.begin(), twentieth, sums.end(), std::greater<>());
  constexpr double rounding = 1e-9;
  return *twentieth * (1 + rounding);
}

}  // namespace

double studentQuantile(double degrees) {
  constexpr double z = 1.959963984540054;
  constexpr double z3 = z * z * z;
  constexpr double z5 = z3 * z * z;
  constexpr double z7 = z5 * z * z;
  constexpr double z9 = z7 * z * z;
  const double n = 1 / degrees;
  return z + n * ((z3 + z) / 4 +
                  n * ((5 * z5 + 16 * z3 + 3 * z) / 96 +
                       n * ((3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / 384 +
                            n * (79 * z9 + 776 * z7 + 1482 * z5 - 1920 * z3 - 945 * z) / 92160)));
}

Tiling chooseTiling(const Mask& view, std::span<const double> weights) {
  requireSameView(view, view);
  requireOnePerSample(weights.size(), view.size(), "weight");
  const double samples = effectiveBlocks(view, weights, 1);
  int cell = std::max(1, static_cast<int>(std::sqrt(samples / leastBlocks) / 2));
  while (cell > 1 && effectiveBlocks(view, weights, 2 * cell) < static_cast<double>(leastBlocks)) {
    cell = std::min(cell - 1, static_cast<int>(0.95 * cell));
  }
  return {cell, std::max(1, (view.width + cell - 1) / cell)};
}

ConfidenceInterval differenceConfidence(const BlockErrors& first, const BlockErrors& second,
                                        const Tiling& tiling) {
  const ConfidenceInterval found = intervalOf(first, second, tiling, -1, 1);
  if (first.answersAlike(second)) return {{}, "both give the same answers", found.blocks, true};
  if (found.interval || found.blocks < leastBlocks) return found;
  const auto weightOf = [](const BlockErrors& errors) {
    return std::accumulate(errors.weight.begin(), errors.weight.end(), 0.0);
  };
  const auto parts = [&](int merged) {
    return partsOf(blocksOf(first, second, tiling.columns, merged), weightOf(first),
                   weightOf(second));
  };
  const std::vector<double> blocks = parts(2);
  if (blocks.empty()) return {{}, "no block of the view differs", found.blocks};
  const double half =
      halfOfFlips(blocks) * correctionOf(rootSumOfSquares(blocks), rootSumOfSquares(parts(1)));
  const double centre = first.rate() - second.rate();
  return {Interval{std::max(-1.0, centre - half), std::min(1.0, centre + half)}, {}, found.blocks};
}

ConfidenceInterval rateConfidence(const BlockErrors& cells, const Tiling& tiling) {
  return intervalOf(cells, {std::vector<double>(cells.wrong.size()), cells.weight}, tiling, 0, 1);
}

}  // namespace gnomon::compare
