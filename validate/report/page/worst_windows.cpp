#include "report/page/worst_windows.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

namespace gnomon::report {
namespace {

/// sums[(y, x)]: the wrong pixels above y and to the left of x.
std::vector<std::size_t> sumsOf(const std::vector<std::uint8_t>& wrong, std::size_t width,
                                std::size_t height) {
  const std::size_t row = width + 1;
  std::vector<std::size_t> sums(row * (height + 1), 0);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      sums[(y + 1) * row + x + 1] = wrong[y * width + x] + sums[y * row + x + 1] +
                                    sums[(y + 1) * row + x] - sums[y * row + x];
    }
  }
  return sums;
}

bool overlaps(const Window& a, int left, int top) {
  return std::abs(a.left - left) < a.side && std::abs(a.top - top) < a.side;
}

}  // namespace

std::vector<Window> worstWindows(const std::vector<std::uint8_t>& wrong, int width, int height,
                                 int side, std::size_t most) {
  side = std::min({side, width, height});
  std::vector<Window> found;
  if (side < 1) return found;
  const std::size_t row = static_cast<std::size_t>(width) + 1;
  const std::vector<std::size_t> sums =
      sumsOf(wrong, static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  const auto sum = [&](int x, int y) {
    return sums[static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x)];
  };
  while (found.size() < most) {
    Window worst;
    for (int y = 0; y + side <= height; ++y) {
      for (int x = 0; x + side <= width; ++x) {
        const std::size_t inside =
            sum(x + side, y + side) + sum(x, y) - sum(x + side, y) - sum(x, y + side);
        if (inside <= worst.wrong) continue;
        const bool isFree = std::none_of(
            found.begin(), found.end(), [&](const Window& other) { return overlaps(other, x, y); });
        if (isFree) worst = {x, y, side, inside};
      }
    }
    if (worst.wrong == 0) break;
    found.push_back(worst);
  }
  return found;
}

}  // namespace gnomon::report
