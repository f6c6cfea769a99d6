#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/mask.h"

namespace gnomon {

/// Samples of a mask as four a byte, the first in the lowest bits; the last byte is filled up with
/// lit ones.
std::vector<std::uint8_t> packedShades(std::span<const Shade> samples);

/// The first `count` samples of such bytes; fewer where there are not so many.
std::vector<Shade> unpackedShades(std::span<const std::uint8_t> packed, std::size_t count);

}  // namespace gnomon
