#pragma once

#include "gnomon/horizon.h"
#include "relief/height_field.h"

namespace gnomon {
inline namespace api {

/// A copy of a height map, checked.
/// @throws InputError as HeightField, and for heights that no study may have
relief::HeightField heightFieldOf(const HeightMap& map);

}  // namespace api
}  // namespace gnomon
