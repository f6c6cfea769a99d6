#pragma once

#include "relief/height_field.h"
#include "relief/solid_map.h"

namespace gnomon::relief {

/// An image projected along the three axes of space onto a surface, and blended by its normal n:
///
///   f(p, n) = Σ_i w_i g(p_{i+1}, p_{i+2}),  w_i = |n_i|^k / Σ_j |n_j|^k,  k = 4, i modulo 3,
///
/// g the image over a plane: `period` world units wide, its texels square, its lower left corner at
/// the origin. It continues in mirror images of itself, so that any image is continuous there.
///
/// k = 4, since f is to have no features of its own: the weights are smooth where a component of n
/// changes its sign (k = 1 has a crease there, |n_i|), one image has nine tenths and more of the
/// weight up to 30° from its axis, tan⁴ 30° = 1/9, and midway between two axes the weights change
/// by k/2 = 2 a radian, less than the image does unless the surface bends on the scale of its
/// features.
///
/// @param image   of heights of the value 1; how it wraps does not matter
/// @param period  world units, above 0
/// @throws InputError naming the key for a period that is not above 0 or over 1e9
SurfaceFunction triplanar(HeightField image, double period);

}  // namespace gnomon::relief
