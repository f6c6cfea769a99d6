#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace gnomon {

/// What every bootstrap needs.

/// Whole numbers below a bound, each as likely: the library's own distributions differ between
/// systems.
class Draws {
 public:
  /// @param bound  1 or more
  Draws(std::uint64_t seed, std::size_t bound)
      : bound_(bound),
        last_(std::numeric_limits<std::uint64_t>::max() -
              std::numeric_limits<std::uint64_t>::max() % bound_ - 1),
        generator_(seed) {}

  std::size_t next() {
    std::uint64_t number = generator_();
    while (number > last_) number = generator_();
    return static_cast<std::size_t>(number % bound_);
  }

 private:
  std::uint64_t bound_;
  std::uint64_t last_;  ///< the last number of the last whole run of `bound_`
  std::mt19937_64 generator_;
};

/// Linear between the two nearest of the sorted values.
/// @param sorted  one value or more
/// @param share   0 (the first) to 1 (the last)
double percentile(const std::vector<double>& sorted, double share);

}  // namespace gnomon
