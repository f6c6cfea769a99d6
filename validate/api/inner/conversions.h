#pragma once

#include <cstdint>
#include <optional>

#include "common/mask.h"
#include "gnomon/horizon.h"
#include "gnomon/surface.h"
#include "relief/height_field.h"
#include "surface/cage/cage.h"
#include "surface/limit_surface.h"

// The library's own types behind those of the public headers.

namespace gnomon {
inline namespace api {

/// A mask's bytes are those of its shares, V: 1 lit, 0 shadowed; and 2 where there is no answer.
inline std::uint8_t byteOf(Shade shade) {
  return shade == Shade::lit ? 1 : shade == Shade::shadowed ? 0 : 2;
}

/// None for a byte that is no answer and not 2 either.
inline std::optional<Shade> shadeOf(std::uint8_t byte) {
  if (byte > 2) return std::nullopt;
  return byte == 1 ? Shade::lit : byte == 0 ? Shade::shadowed : Shade::none;
}

/// A copy of a height map, checked.
/// @throws InputError as HeightField, and for heights that no study may have
relief::HeightField heightFieldOf(const HeightMap& map);

/// What a Surface holds.
struct Surface::Data {
  explicit Data(surface::Cage of) : cage(std::move(of)), limit(cage) {}

  surface::Cage cage;
  surface::LimitSurface limit;
};

}  // namespace api
}  // namespace gnomon
