#pragma once

#include "common/mask.h"
#include "compare/shadow_length.h"
#include "truth/shadow_tracer.h"

namespace gnomon {

/// Lengths of a mask's shadows over the truth's, of those alone that an occluder casts (regions
/// `cast` and `distant`): an attached shadow has no end to measure.
/// @throws InputError as `compareShadowLengths`
ShadowLengths castLengths(const Mask& mask, const Truth& truth, const LightField& field);

}  // namespace gnomon
