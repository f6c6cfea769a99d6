#include "study/run/scene/cast_lengths.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace gnomon::study {

compare::ShadowLengths castLengths(const Mask& mask, const truth::Truth& truth,
                                   const compare::LightField& field) {
  const std::array<const Mask*, 1> one = {&mask};
  return castLengths(one, truth, field).front();
}

std::vector<compare::ShadowLengths> castLengths(std::span<const Mask* const> masks,
                                                const truth::Truth& truth,
                                                const compare::LightField& field) {
  std::vector<std::uint8_t> isCast(truth.mask.size());
  std::transform(
      truth.regions.begin(), truth.regions.end(), isCast.begin(),
      [](truth::Region region) { return static_cast<std::uint8_t>(truth::isCastShadow(region)); });
  return compare::compareShadowLengths(masks, truth.mask, field, isCast);
}

}  // namespace gnomon::study
