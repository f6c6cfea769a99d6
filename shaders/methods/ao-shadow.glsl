/* gnomon-method
title = "Shadow from ambient occlusion, a cone of light"
citation = "Chan 2018, as in Filament"
family = "engine"
symbol = "circle"
*/

// An ambient occlusion map says how much of the sky a point sees, and not where. Taken as a cone about
// the normal, of the half angle α, it is A = sin² α, so that the light is in it where
// N·L > cos α = √(1 - A). Softened:
//   V = sat(N·L / √(1 - A))².
// The map is the same for all lights: a point in a pit is dark toward all sides alike.
//
// Chan's notes could not be read; this is Filament's computeMicroShadowing, whose comment cites them.
// N is the normal of the bump map. What an artist's occlusion map holds is left open: here it is
// baked from the exact horizons of the flat relief, over all of the search radius.

#include "parts/openness.glsl"

float visibility(Pixel pixel, LocalLight light) {
  vec3 facing = bumpedNormal(pixel, heightGradient(pixel.texel));
  float cosine = dot(facing, lightDirection);
  float aperture = inversesqrt(max(1.0 - opennessAt(pixel.texel), 1e-8));
  float share = clamp(cosine * aperture, 0.0, 1.0);
  return share * share;
}
