/* gnomon-method
title = "Parallax occlusion mapping's soft shadow"
citation = "Tatarchuk 2006"
family = "engine"
symbol = "inverted-triangle"
tables = ["height"]

[parameters.taps]
default = 7
minimum = 2
maximum = 4096
about = "samples of the height map, evenly from 0.22 to 0.88 of the way"

[parameters.softening]
default = 0.58
minimum = 0
maximum = 1e6
about = "factor of all weights: how hard the shadow's edge is"
*/

// What is hidden grows with how far the relief stands over the ray at a few taps, and a near tap
// counts more than a far one:
//   V = 1 - max wᵢ (h(tᵢ) - h₀ - tᵢ),   heights from 0 to 1 over the map's range H.
// Over the whole way, t = 1, the ray goes H L_xy of the unit vector L sideways and rises by all of
// H, where it ought to rise by H L_z: as if it stood at the slope 1 / cos θ in place of tan θ, so that
// shadows are too short. That is the source's own.
//
// The paper itself could not be read. Taps, weights and softening are those of its author's sample of
// the DirectX SDK. There V is brightened to 0.6 V + 0.4 for the picture, which is no visibility and
// left out here. The sample's taps have the weights 12, 10, 8, 6, 4, 2, 1.

const float firstTap = 0.22;
const float lastTap = 0.88;

float visibility(Pixel pixel, LocalLight light) {
  float range = max(heightBounds.y - heightBounds.x, 1e-20);
  // Texels that the ray goes for t = 1.
  float way = pixel.worldPerHeight * range * length(light.tangent) / light.worldPerTexel;
  float known = knownDistance(pixel.texel, light.direction);
  float height = heightAt(pixel.texel);
  float hidden = 0.0;
  for (float i = 0.0; i < floor(taps); i += 1.0) {
    float t = mix(firstTap, lastTap, i / (floor(taps) - 1.0));
    if (t * way > known) break;
    float over = (heightAt(pixel.texel + t * way * light.direction) - height) / range - t;
    float weight = max((lastTap - t) / 0.055, 1.0);
    hidden = max(hidden, softening * weight * over);
  }
  return clamp(1.0 - hidden, 0.0, 1.0);
}
