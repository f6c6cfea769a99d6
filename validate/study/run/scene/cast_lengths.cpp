#include "study/run/scene/cast_lengths.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace gnomon {

ShadowLengths castLengths(const Mask& mask, const Truth& truth, const LightField& field) {
  std::vector<std::uint8_t> isCast(mask.size());
  std::transform(truth.regions.begin(), truth.regions.end(), isCast.begin(), [](Region region) {
    return static_cast<std::uint8_t>(region == Region::cast || region == Region::distant);
  });
  return compareShadowLengths(mask, truth.mask, field, isCast);
}

}  // namespace gnomon
