#include "compare/confidence_interval.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "compare/mask_checks.h"
#include "compare/resampling.h"

namespace gnomon {
namespace {

/// One block of both answers.
struct PairedBlock {
  double firstWrong = 0;
  double firstWeight = 0;
  double secondWrong = 0;
  double secondWeight = 0;

  PairedBlock& operator+=(const PairedBlock& other) {
    firstWrong += other.firstWrong;
    firstWeight += other.firstWeight;
    secondWrong += other.secondWrong;
    secondWeight += other.secondWeight;
    return *this;
  }
  [[nodiscard]] bool isHeld() const { return firstWeight > 0 || secondWeight > 0; }
};

double ratio(double part, double whole) {
  return whole > 0 ? part / whole : 0;
}

/// A difference of rates over some blocks, and how much each block deviates from it.
class PairedRates {
 public:
  explicit PairedRates(const PairedBlock& sum)
      : sum_(sum),
        first_(ratio(sum.firstWrong, sum.firstWeight)),
        second_(ratio(sum.secondWrong, sum.secondWeight)) {}

  [[nodiscard]] double difference() const { return first_ - second_; }
  /// d_k; their sum is 0.
  [[nodiscard]] double deviation(const PairedBlock& block) const {
    return ratio(block.firstWrong - first_ * block.firstWeight, sum_.firstWeight) -
           ratio(block.secondWrong - second_ * block.secondWeight, sum_.secondWeight);
  }

 private:
  PairedBlock sum_;
  double first_;
  double second_;
};

PairedBlock sumOf(const std::vector<PairedBlock>& blocks) {
  PairedBlock sum;
  for (const PairedBlock& block : blocks) sum += block;
  return sum;
}

/// √(K / (K - 1) Σ d²)
double standardError(double squares, std::size_t blocks) {
  const auto count = static_cast<double>(blocks);
  return std::sqrt(squares * count / (count - 1));
}

double standardError(const std::vector<PairedBlock>& blocks) {
  const PairedRates rates(sumOf(blocks));
  double squares = 0;
  for (const PairedBlock& block : blocks) {
    const double deviation = rates.deviation(block);
    squares += deviation * deviation;
  }
  return standardError(squares, blocks.size());
}

/// Blocks of `merged` × `merged` cells that hold a sample, row by row.
std::vector<PairedBlock> blocksOf(const BlockErrors& first, const BlockErrors& second, int columns,
                                  int merged) {
  const auto width = static_cast<std::size_t>(columns);
  const auto step = static_cast<std::size_t>(merged);
  const std::size_t blockColumns = (width + step - 1) / step;
  const std::size_t rows = (first.wrong.size() / width + step - 1) / step;
  std::vector<PairedBlock> blocks(blockColumns * rows);
  for (std::size_t i = 0; i < first.wrong.size(); ++i) {
    blocks[i / width / step * blockColumns + i % width / step] +=
        PairedBlock{first.wrong[i], first.weight[i], second.wrong[i], second.weight[i]};
  }
  std::erase_if(blocks, [](const PairedBlock& block) { return !block.isHeld(); });
  return blocks;
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

void requireSettings(const BootstrapSettings& settings) {
  if (settings.resamples >= 1 && settings.confidence > 0 && settings.confidence < 1) return;
  throw InternalError(
      fmt::format("{} resamples and confidence {} found", settings.resamples, settings.confidence));
}

/// t* of one resample, whose sum is not known before all its blocks are.
double studentised(const std::vector<PairedBlock>& blocks, std::span<const std::uint32_t> drawn,
                   double difference) {
  PairedBlock sum;
  for (const std::uint32_t k : drawn) sum += blocks[k];
  const PairedRates rates(sum);
  double squares = 0;
  for (const std::uint32_t k : drawn) {
    const double deviation = rates.deviation(blocks[k]);
    squares += deviation * deviation;
  }
  const double moved = rates.difference() - difference;
  if (moved == 0) return 0;
  // Infinite where all blocks drawn are alike: rare, and no number would be true.
  return moved / standardError(squares, blocks.size());
}

std::vector<double> sortedResamples(const std::vector<PairedBlock>& blocks,
                                    const Bootstrap& bootstrap) {
  const double difference = PairedRates(sumOf(blocks)).difference();
  const std::span<const std::uint32_t> draws = bootstrap.draws(blocks.size());
  std::vector<double> values(draws.size() / blocks.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = studentised(blocks, draws.subspan(i * blocks.size(), blocks.size()), difference);
  }
  std::sort(values.begin(), values.end());
  return values;
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

}  // namespace

const std::vector<std::uint32_t>& Bootstrap::draws(std::size_t blocks) const {
  const std::lock_guard lock(drawing_);
  std::vector<std::uint32_t>& drawn = draws_[blocks];
  if (drawn.empty()) {
    drawn.resize(static_cast<std::size_t>(settings_.resamples) * blocks);
    Draws draws(settings_.seed, blocks);
    for (std::uint32_t& k : drawn) k = static_cast<std::uint32_t>(draws.next());
  }
  return drawn;
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
                                        const Tiling& tiling, const Bootstrap& bootstrap) {
  requireCells(first, second, tiling);
  requireSettings(bootstrap.settings());
  const std::vector<PairedBlock> blocks = blocksOf(first, second, tiling.columns, 2);
  if (blocks.size() < leastBlocks) {
    return {{}, "the view has too few blocks of samples", blocks.size()};
  }
  const double whole = standardError(blocks);
  const double difference = PairedRates(sumOf(blocks)).difference();
  const auto differing = std::count_if(blocks.begin(), blocks.end(), [](const PairedBlock& block) {
    return block.firstWrong != block.secondWrong;
  });
  if (differing == 0 && difference == 0) return {Interval{0, 0}, {}, blocks.size()};
  if (differing < static_cast<std::ptrdiff_t>(leastWrongBlocks)) {
    return {{}, "too few blocks of the view differ", blocks.size()};
  }
  if (!(whole > 0)) return {Interval{difference, difference}, {}, blocks.size()};
  const double halved = standardError(blocksOf(first, second, tiling.columns, 1));
  const double error = whole * std::clamp(2 - halved / whole, 1.0, largestCorrection);
  const std::vector<double> resamples = sortedResamples(blocks, bootstrap);
  const double tail = (1 - bootstrap.settings().confidence) / 2;
  const Interval interval{difference - error * percentile(resamples, 1 - tail),
                          difference - error * percentile(resamples, tail)};
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) {
    return {{}, "too few blocks of the view differ", blocks.size()};
  }
  return {interval, {}, blocks.size()};
}

ConfidenceInterval rateConfidence(const BlockErrors& cells, const Tiling& tiling,
                                  const Bootstrap& bootstrap) {
  const BlockErrors none{std::vector<double>(cells.wrong.size()), cells.weight};
  ConfidenceInterval confidence = differenceConfidence(cells, none, tiling, bootstrap);
  const bool isRight =
      std::all_of(cells.wrong.begin(), cells.wrong.end(), [](double wrong) { return wrong == 0; });
  if (isRight || (!confidence.interval && confidence.blocks >= leastBlocks)) {
    return {{}, "too few blocks of the view hold an error", confidence.blocks};
  }
  if (confidence.interval) {
    confidence.interval->low = std::clamp(confidence.interval->low, 0.0, 1.0);
    confidence.interval->high = std::clamp(confidence.interval->high, 0.0, 1.0);
  }
  return confidence;
}

}  // namespace gnomon
