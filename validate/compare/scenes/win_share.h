#pragma once

#include <cstddef>
#include <span>

#include "compare/confidence_interval.h"

namespace gnomon::compare {

/// How often the first of two methods beats the second.
struct WinShare {
  std::size_t scenes = 0;  ///< on which both were measured
  std::size_t wins = 0;  ///< the first has the smaller error, by more than the truth's uncertainty
  std::size_t ties = 0;  ///< they differ by no more than that
  /// (wins + ties / 2) / scenes: the probability that the first beats the second on a new scene.
  double probability = 0;
  /// 95 %, by Wilson's score (1927): the p for which the share is no more than 1.96 standard
  /// deviations √(p (1 - p) / n) away. Ties vary less than wins do, so with ties it is rather too
  /// wide.
  Interval interval = {};
};

/// @param first, second  errors on the same scenes, at least one
/// @param uncertainty    of the truth, one a scene
/// @throws InternalError where the numbers of values differ or there is none
WinShare winShare(std::span<const double> first, std::span<const double> second,
                  std::span<const double> uncertainty);

/// Wilson's interval.
/// @param share  0 to 1
/// @param count  1 or more
Interval wilsonInterval(double share, std::size_t count);

/// The same of the second method.
WinShare swapped(const WinShare& share);

}  // namespace gnomon::compare
