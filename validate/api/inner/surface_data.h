#pragma once

#include "gnomon/surface.h"
#include "surface/cage/cage.h"
#include "surface/limit_surface.h"

namespace gnomon {
inline namespace api {

/// What a Surface holds.
struct Surface::Data {
  explicit Data(surface::Cage of) : cage(std::move(of)), limit(cage) {}

  surface::Cage cage;
  surface::LimitSurface limit;
};

}  // namespace api
}  // namespace gnomon
