#include "compare/worst_windows.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/raw_vector.h"

namespace gnomon::compare {
namespace {

/// Errors in whole steps, so that windows of equal errors have equal sums wherever they lie.
struct ShareErrors {
  using Sum = std::int64_t;
  static constexpr double steps = 65536;
  static Sum inSteps(float error) {
    if (error == 0) return 0;  // most are
    return std::llround(steps * error);
  }
};
struct MaskErrors {
  using Sum = std::int32_t;
  static constexpr double steps = 1;
  static Sum inSteps(std::uint8_t error) { return error; }
};

/// sums[(y, x)]: the errors above y and to the left of x, in steps.
template <typename Kind, typename Error>
RawVector<typename Kind::Sum> sumsOf(std::span<const Error> errors, std::size_t width,
                                     std::size_t height) {
  using Sum = typename Kind::Sum;
  const std::size_t row = width + 1;
  RawVector<Sum> sums(row * (height + 1));
  std::fill_n(sums.begin(), row, 0);
  for (std::size_t y = 0; y < height; ++y) {
    const Sum* above = &sums[y * row];
    Sum* own = &sums[(y + 1) * row];
    Sum inRow = 0;
    own[0] = 0;
    for (std::size_t x = 0; x < width; ++x) {
      inRow += Kind::inSteps(errors[y * width + x]);
      own[x + 1] = above[x + 1] + inRow;
    }
  }
  return sums;
}

bool overlaps(const Window& a, int left, int top) {
  return std::abs(a.left - left) < a.side && std::abs(a.top - top) < a.side;
}

template <typename Kind, typename Error>
std::vector<Window> windowsOf(std::span<const Error> errors, int width, int height, int side,
                              std::size_t most) {
  using Sum = typename Kind::Sum;
  side = std::min({side, width, height});
  std::vector<Window> found;
  if (side < 1) return found;
  const std::size_t row = static_cast<std::size_t>(width) + 1;
  const RawVector<Sum> sums =
      sumsOf<Kind>(errors, static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  while (found.size() < most) {
    Window worst;
    Sum largest = 0;
    for (int y = 0; y + side <= height; ++y) {
      const Sum* top = &sums[static_cast<std::size_t>(y) * row];
      const Sum* bottom = &sums[static_cast<std::size_t>(y + side) * row];
      for (int x = 0; x + side <= width; ++x) {
        const Sum inside = (bottom[x + side] - bottom[x]) - (top[x + side] - top[x]);
        if (inside <= largest) continue;
        const bool isFree = std::none_of(
            found.begin(), found.end(), [&](const Window& other) { return overlaps(other, x, y); });
        if (!isFree) continue;
        worst = {x, y, side, static_cast<double>(inside) / Kind::steps};
        largest = inside;
      }
    }
    if (largest == 0) break;
    found.push_back(worst);
  }
  return found;
}

}  // namespace

std::vector<Window> worstWindows(std::span<const float> errors, int width, int height, int side,
                                 std::size_t most) {
  return windowsOf<ShareErrors>(errors, width, height, side, most);
}

std::vector<Window> worstWindows(std::span<const std::uint8_t> errors, int width, int height,
                                 int side, std::size_t most) {
  return windowsOf<MaskErrors>(errors, width, height, side, most);
}

}  // namespace gnomon::compare
