#include "common/visibility.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

Visibility asShares(const Mask& mask) {
  Visibility map{mask.width, mask.height, {}};
  map.shares.reserve(mask.size());
  for (const Shade shade : mask.samples) {
    map.shares.push_back(shade == Shade::none ? noSample : shade == Shade::lit ? 1.0F : 0.0F);
  }
  return map;
}

bool isSame(const Visibility& a, const Visibility& b) {
  return a.width == b.width && a.height == b.height &&
         std::equal(a.shares.begin(), a.shares.end(), b.shares.begin(), b.shares.end(),
                    [](float one, float other) {
                      return one == other || (std::isnan(one) && std::isnan(other));
                    });
}

Mask cutInHalf(const Visibility& map) {
  Mask mask{map.width, map.height, {}};
  mask.samples.reserve(map.size());
  for (const float share : map.shares) {
    mask.samples.push_back(std::isnan(share) ? Shade::none
                           : share < 0.5F    ? Shade::shadowed
                                             : Shade::lit);
  }
  return mask;
}

}  // namespace gnomon
