#include "compare/worst_windows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace gnomon::compare {
namespace {

constexpr double steps = 65536;

/// sums[(y, x)]: the errors above y and to the left of x. In steps of 2⁻¹⁶, so that windows of
/// equal errors have equal sums wherever they lie.
std::vector<std::int64_t> sumsOf(const std::vector<float>& errors, std::size_t width,
                                 std::size_t height) {
  const std::size_t row = width + 1;
  std::vector<std::int64_t> sums(row * (height + 1), 0);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      sums[(y + 1) * row + x + 1] = std::llround(steps * errors[y * width + x]) +
                                    sums[y * row + x + 1] + sums[(y + 1) * row + x] -
                                    sums[y * row + x];
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
  const std::vector<std::int64_t> sums =
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
