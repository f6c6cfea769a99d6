#include "model/progressive_order.h"

#include <fmt/core.h>

#include <bit>
#include <limits>
#include <type_traits>

#include "common/error.h"
#include "common/parallel.h"

namespace gnomon::app {
namespace {

constexpr int tileSide = 4;

void requireStride(int coarsest) {
  if (coarsest >= 1 && std::has_single_bit(static_cast<unsigned>(coarsest))) return;
  throw InternalError(
      fmt::format("progressive order: stride {}, a power of two expected", coarsest));
}

std::size_t indexOf(int width, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(column);
}

/// Appends the nodes of one stride that no coarser one has, in one tile of them.
void appendTile(const surface::SampleGrid& grid, int stride, bool isCoarsest, int left, int top,
                std::vector<std::uint32_t>& order) {
  for (int k = 0; k < tileSide * tileSide; ++k) {
    const int column = left + k % tileSide * stride;
    const int row = top + k / tileSide * stride;
    if (column >= grid.width || row >= grid.height) continue;
    const bool isCoarser = column % (2 * stride) == 0 && row % (2 * stride) == 0;
    if (isCoarser && !isCoarsest) continue;
    const std::size_t index = indexOf(grid.width, column, row);
    if (grid.samples[index].face >= 0) order.push_back(static_cast<std::uint32_t>(index));
  }
}

/// The answers so far around one sample of a mask or a map of shares.
template <typename Map>
class Preview {
 public:
  using Value = std::remove_cvref_t<decltype(absentIn(Map{}))>;

  Preview(const Map& truth, std::span<const std::uint8_t> traced, int coarsest)
      : truth_(truth), traced_(traced), coarsest_(coarsest) {}

  [[nodiscard]] Value at(int column, int row) const {
    const Value own = answer(column, row);
    if (isAnswer(own)) return own;
    for (int stride = 2; stride <= coarsest_; stride *= 2) {
      const Value near = nearest(column, row, stride);
      if (isAnswer(near)) return near;
    }
    return absentIn(truth_);
  }

 private:
  [[nodiscard]] Value answer(int column, int row) const {
    if (column >= truth_.width || row >= truth_.height) return absentIn(truth_);
    const std::size_t index = indexOf(truth_.width, column, row);
    return traced_[index] != 0 ? valuesOf(truth_)[index] : absentIn(truth_);
  }

  /// That of the nearest node with one among the four about a sample.
  [[nodiscard]] Value nearest(int column, int row, int stride) const {
    Value best = absentIn(truth_);
    int least = std::numeric_limits<int>::max();
    for (int k = 0; k < 4; ++k) {
      const int x = column / stride * stride + (k & 1) * stride;
      const int y = row / stride * stride + (k >> 1) * stride;
      const Value found = answer(x, y);
      const int square = (x - column) * (x - column) + (y - row) * (y - row);
      if (!isAnswer(found) || square >= least) continue;
      best = found;
      least = square;
    }
    return best;
  }

  const Map& truth_;
  std::span<const std::uint8_t> traced_;
  int coarsest_;
};

template <typename Map>
Map previewOf(const surface::SampleGrid& samples, const Map& truth,
              std::span<const std::uint8_t> traced, int coarsest) {
  if (truth.width != samples.width || truth.height != samples.height ||
      traced.size() != samples.samples.size() || truth.size() != traced.size()) {
    throw InternalError("preview: truth and view of different sizes");
  }
  auto map = emptyMap<Map>(samples.width, samples.height);
  const Preview<Map> preview(truth, traced, coarsest);
  parallelFor(0, static_cast<std::size_t>(samples.height), [&](std::size_t row) {
    for (int column = 0; column < samples.width; ++column) {
      const std::size_t index = indexOf(samples.width, column, static_cast<int>(row));
      if (!samples.samples[index].isOnSurface()) continue;
      valuesOf(map)[index] = preview.at(column, static_cast<int>(row));
    }
  });
  return map;
}

}  // namespace

ProgressiveOrder progressiveOrder(const surface::SampleGrid& samples, int coarsest) {
  requireStride(coarsest);
  if (samples.samples.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw InternalError("progressive order: more than 2³² samples");
  }
  ProgressiveOrder order;
  for (int stride = coarsest; stride >= 1; stride /= 2) {
    for (int top = 0; top < samples.height; top += tileSide * stride) {
      for (int left = 0; left < samples.width; left += tileSide * stride) {
        appendTile(samples, stride, stride == coarsest, left, top, order.samples);
      }
    }
    order.levelEnds.push_back(order.samples.size());
  }
  return order;
}

Answers preview(const surface::SampleGrid& samples, const Answers& truth,
                std::span<const std::uint8_t> traced, int coarsest) {
  requireStride(coarsest);
  return std::visit(
      [&](const auto& map) { return Answers(previewOf(samples, map, traced, coarsest)); }, truth);
}

}  // namespace gnomon::app
