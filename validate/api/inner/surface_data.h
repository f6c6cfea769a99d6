#pragma once

#include "gnomon/surface.h"
#include "surface/cage/cage.h"
#include "surface/limit_surface.h"

namespace gnomon {
inline namespace api {

/// What a Surface holds.
struct Surface::Data {
  explicit Data(Cage of) : cage(std::move(of)), limit(cage) {}

  Cage cage;
  LimitSurface limit;
};

}  // namespace api
}  // namespace gnomon
