#pragma once

#include "relief/height_field.h"

namespace gnomon::relief {

/// The same relief on a finer map: `factor` times as many texels along x and y, each the height of
/// the bilinear function at its centre. For an odd factor every old texel centre is a new one, so
/// that the old function's kinks stay kinks of the new one, and both are the same function up to
/// float rounding: h'(factor · p) = scale · h(p) everywhere, beyond the border too.
/// @param factor  odd, at least 1
/// @param scale   new height units per old one: `factor` where heights are texels
/// @throws InternalError for an even factor; MemoryError naming `factor` where the finer map cannot
///   fit
HeightField resampledHeights(const HeightField& field, int factor, double scale);

}  // namespace gnomon::relief
