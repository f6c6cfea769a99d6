/* gnomon-method
title = "Micro shadow from ambient occlusion"
citation = "Naughty Dog 2016 (Uncharted 4)"
family = "engine"
symbol = "square"
*/

// As ao-shadow, by a straight line in place of a cone: with the aperture 2 A², the square of the
// share of the sky that the point sees,
//   V = sat(|N·L| + 2 A² - 1).
//
// The talk's slides could not be read; the formula is as renderers quote it that cite them. N is the
// normal of the bump map, and the occlusion map is ao-shadow's.

#include "parts/openness.glsl"

float visibility(Pixel pixel, LocalLight light) {
  vec3 facing = bumpedNormal(pixel, heightGradient(pixel.texel));
  float openness = opennessAt(pixel.texel);
  return clamp(abs(dot(facing, lightDirection)) + 2.0 * openness * openness - 1.0, 0.0, 1.0);
}
