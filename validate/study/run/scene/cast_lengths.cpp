#include "study/run/scene/cast_lengths.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace gnomon {

ShadowLengths castLengths(const Mask& mask, const Truth& truth, const LightField& field) {
  const std::array<const Mask*, 1> one = {&mask};
  return castLengths(one, truth, field).front();
}

std::vector<ShadowLengths> castLengths(std::span<const Mask* const> masks, const Truth& truth,
                                       const LightField& field) {
  std::vector<std::uint8_t> isCast(truth.mask.size());
  std::transform(truth.regions.begin(), truth.regions.end(), isCast.begin(), [](Region region) {
    return static_cast<std::uint8_t>(region == Region::cast || region == Region::distant);
  });
  return compareShadowLengths(masks, truth.mask, field, isCast);
}

}  // namespace gnomon
