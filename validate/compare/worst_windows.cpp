#include "compare/worst_windows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "common/raw_vector.h"

namespace gnomon::compare {
namespace {

constexpr double steps = 65536;

/// An error in steps of 2⁻¹⁶, so that windows of equal errors have equal sums wherever they lie.
std::int64_t inSteps(float error) {
  if (error == 0) return 0;  // most are
  return std::llround(steps * error);
}

/// sums[(y, x)]: the errors above y and to the left of x, in steps.
RawVector<std::int64_t> sumsOf(const std::vector<float>& errors, std::size_t width,
                               std::size_t height) {
  const std::size_t row = width + 1;
  RawVector<std::int64_t> sums(row * (height + 1));
  std::fill_n(sums.begin(), row, 0);
  for (std::size_t y = 0; y < height; ++y) {
    const std::int64_t* above = &sums[y * row];
    std::int64_t* own = &sums[(y + 1) * row];
    std::int64_t inRow = 0;
    own[0] = 0;
    for (std::size_t x = 0; x < width; ++x) {
      inRow += inSteps(errors[y * width + x]);
      own[x + 1] = above[x + 1] + inRow;
    }
  }
  return sums;
}

bool overlaps(const Window& a, int left, int top) {
  return std::abs(a.left - left) < a.side && std::abs(a.top - top) < a.side;
}

}  // namespace

std::vector<Window> worstWindows(const std::vector<float>& errors, int width, int height, int side,
                                 std::size_t most) {
  side = std::min({side, width, height});
  std::vector<Window> found;
  if (side < 1) return found;
  const std::size_t row = static_cast<std::size_t>(width) + 1;
  const RawVector<std::int64_t> sums =
      sumsOf(errors, static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  const auto sum = [&](int x, int y) {
    return sums[static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x)];
  };
  while (found.size() < most) {
    Window worst;
    std::int64_t largest = 0;
    for (int y = 0; y + side <= height; ++y) {
      for (int x = 0; x + side <= width; ++x) {
        const std::int64_t inside =
            sum(x + side, y + side) + sum(x, y) - sum(x + side, y) - sum(x, y + side);
        if (inside <= largest) continue;
        const bool isFree = std::none_of(
            found.begin(), found.end(), [&](const Window& other) { return overlaps(other, x, y); });
        if (!isFree) continue;
        worst = {x, y, side, static_cast<double>(inside) / steps};
        largest = inside;
      }
    }
    if (largest == 0) break;
    found.push_back(worst);
  }
  return found;
}

}  // namespace gnomon::compare
