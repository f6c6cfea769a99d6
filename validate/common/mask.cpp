#include "common/mask.h"

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

std::vector<std::uint8_t> packedShades(std::span<const Shade> samples) {
  const auto bits = [&](std::size_t i) { return static_cast<unsigned>(samples[i]); };
  std::vector<std::uint8_t> packed((samples.size() + 3) / 4);
  const std::size_t whole = samples.size() / 4;
  for (std::size_t b = 0; b < whole; ++b) {
    const std::size_t i = 4 * b;
    packed[b] =
        static_cast<std::uint8_t>(bits(i) | bits(i + 1) << 2 | bits(i + 2) << 4 | bits(i + 3) << 6);
  }
  for (std::size_t i = 4 * whole; i < samples.size(); ++i) {
    packed[whole] = static_cast<std::uint8_t>(packed[whole] | bits(i) << (2 * (i % 4)));
  }
  return packed;
}

std::vector<Shade> unpackedShades(std::span<const std::uint8_t> packed, std::size_t count) {
  std::vector<Shade> samples(std::min(count, 4 * packed.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = static_cast<Shade>(packed[i / 4] >> (2 * (i % 4)) & 3U);
  }
  return samples;
}

}  // namespace gnomon
