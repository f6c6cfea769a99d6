#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "common/mask.h"

namespace gnomon::test {

/// Smooth random fields: white noise under a Gaussian of the standard deviation `scale`, in
/// samples. Each value is normal with mean 0 and variance 1, two of them at the distance r have the
/// correlation exp(-r² / 4 scale²).
class RandomFields {
 public:
  RandomFields(int side, double scale, std::uint64_t seed) : side_(side), generator_(seed) {
    const int reach = static_cast<int>(std::ceil(3 * scale));
    double squares = 0;
    for (int i = -reach; i <= reach; ++i) {
      kernel_.push_back(static_cast<float>(std::exp(-i * i / (2 * scale * scale))));
      squares += kernel_.back() * kernel_.back();
    }
    for (float& k : kernel_) k /= static_cast<float>(std::sqrt(squares));
  }

  /// side × side values.
  std::vector<float> next() {
    const std::size_t taps = kernel_.size();
    const auto side = static_cast<std::size_t>(side_);
    const std::size_t padded = side + taps - 1;
    std::vector<float> noise(padded * padded);
    for (float& value : noise) value = normal();
    std::vector<float> rows(padded * side);
    for (std::size_t y = 0; y < padded; ++y) {
      for (std::size_t j = 0; j < taps; ++j) {
        for (std::size_t x = 0; x < side; ++x) {
          rows[y * side + x] += kernel_[j] * noise[y * padded + j + x];
        }
      }
    }
    std::vector<float> field(side * side);
    for (std::size_t y = 0; y < side; ++y) {
      for (std::size_t j = 0; j < taps; ++j) {
        for (std::size_t x = 0; x < side; ++x) {
          field[y * side + x] += kernel_[j] * rows[(y + j) * side + x];
        }
      }
    }
    return field;
  }

 private:
  /// A pair of normal numbers (Box & Muller 1958), one after the other.
  float normal() {
    if (hasSpare_) {
      hasSpare_ = false;
      return spare_;
    }
    constexpr double scale = 0x1p-53;
    const double u = static_cast<double>((generator_() >> 11) + 1) * scale;
    const double angle =
        2 * 3.14159265358979323846 * static_cast<double>(generator_() >> 11) * scale;
    const double radius = std::sqrt(-2 * std::log(u));
    spare_ = static_cast<float>(radius * std::sin(angle));
    hasSpare_ = true;
    return static_cast<float>(radius * std::cos(angle));
  }

  int side_;
  std::vector<float> kernel_;
  std::mt19937_64 generator_;
  float spare_ = 0;
  bool hasSpare_ = false;
};

/// The probability of a normal number below x.
inline double normalBelow(double x) {
  return std::erfc(-x / std::sqrt(2.0)) / 2;
}

/// The x that a normal number exceeds with this probability.
inline double normalAbove(double probability) {
  double low = -9;
  double high = 9;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (1 - normalBelow(middle) > probability ? low : high) = middle;
  }
  return low;
}

/// Which samples of a field are wrong.
enum class ErrorShape {
  blobs,     ///< where it is large: whole shadows missing
  contours,  ///< where it is nearly 0: shadows a little too large
};

/// `share` of one field and the rest of another: normal numbers again, if both are.
inline std::vector<float> mixed(const std::vector<float>& common, const std::vector<float>& own,
                                double share) {
  std::vector<float> field(common.size());
  const auto a = static_cast<float>(std::sqrt(share));
  const auto b = static_cast<float>(std::sqrt(1 - share));
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = a * common[i] + b * own[i];
  return field;
}

/// A mask over a truth that is lit everywhere, wrong with a probability of its own in each column.
/// @param rates  one a column
inline Mask errorMask(const std::vector<float>& field, int side, ErrorShape shape,
                      const std::vector<double>& rates) {
  std::vector<float> levels;
  for (const double rate : rates) {
    levels.push_back(
        static_cast<float>(normalAbove(shape == ErrorShape::blobs ? rate : (1 - rate) / 2)));
  }
  Mask mask{side, side, {}};
  for (std::size_t i = 0; i < field.size(); ++i) {
    const float level = levels[i % levels.size()];
    const bool wrong = shape == ErrorShape::blobs ? field[i] > level : std::abs(field[i]) < level;
    mask.samples.push_back(wrong ? Shade::shadowed : Shade::lit);
  }
  return mask;
}

/// The same with one probability everywhere.
inline Mask errorMask(const std::vector<float>& field, int side, ErrorShape shape, double rate) {
  return errorMask(field, side, shape, std::vector<double>{rate});
}

}  // namespace gnomon::test
