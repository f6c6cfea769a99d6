/* gnomon-method
title = "Displaced mesh with a variance shadow map"
citation = "Donnelly & Lauritzen 2006; Lauritzen 2007"
family = "displaced"
symbol = "inverted-triangle"
mesh = "displaced"
subdivisions = 9

[[pass]]
name = "moments"
kind = "light"
channels = 2
clear = 1
about = "depth and its square"

[[pass]]
name = "rows"
kind = "filter"
of = "moments"
channels = 2
about = "their means along x"

[[pass]]
name = "blurred"
kind = "filter"
of = "rows"
channels = 2
about = "their means over a square"

[parameters.depth_side]
default = 2048
minimum = 16
maximum = 8192
type = "int"
about = "texels a side of the depth map, which holds the whole surface"

[parameters.width]
default = 5
minimum = 1
maximum = 65
type = "int"
about = "side of the square that moments are filtered over, texels; odd"

[parameters.least_variance]
default = 1e-7
minimum = 0
maximum = 1
about = "of depths, 0 to 1: what rounding is worth"

[parameters.bleeding]
default = 0
minimum = 0
maximum = 0.99
about = "share of the light below which V is cut to 0, and the rest is stretched: 2007's remedy"
*/

// A depth map can be filtered, if its texels hold depths and their squares: of the depths under a
// filter the mean μ and the variance σ² = E(x²) - μ² are known, and so how much of them at most is no
// nearer to the light than a receiver at the depth t (Chebyshev's inequality, one-sided):
//   V = σ² / (σ² + (t - μ)²) for t > μ, else 1.
// It is exact for two flat depths, a blocker's and its receiver's. Elsewhere it errs toward light, and
// lets it bleed through where blockers stand at several depths.
//
// Within a texel the depth runs over the facet: the square of its mean and a quarter of the squares of
// its derivatives are stored (2007, §8.4.2). The chapter of 2007 (GPU Gems 3) could be read in part;
// the filter's width, and the least variance, are left open.

vec2 passMoments(Pixel pixel, float depth) {
  vec2 tilt = vec2(dFdx(depth), dFdy(depth));
  return vec2(depth, depth * depth + 0.25 * dot(tilt, tilt));
}

vec2 passRows(ivec2 texel) {
  vec2 sum = vec2(0.0);
  for (int k = -(width / 2); k <= width / 2; ++k) sum += momentsTexel(texel + ivec2(k, 0));
  return sum / float(width / 2 * 2 + 1);
}

vec2 passBlurred(ivec2 texel) {
  vec2 sum = vec2(0.0);
  for (int k = -(width / 2); k <= width / 2; ++k) sum += rowsTexel(texel + ivec2(0, k));
  return sum / float(width / 2 * 2 + 1);
}

float visibility(Pixel pixel, LocalLight light) {
  float cosine = dot(facetNormal(pixel), lightDirection);
  vec3 place = lightMapPlace(pixel.position);
  vec2 moments = blurredAt(place.xy);
  float variance = max(moments.y - moments.x * moments.x, least_variance);
  float behind = max(place.z - moments.x, 0.0);
  float share = variance / (variance + behind * behind);
  return cosine > 0.0 ? max((share - bleeding) / (1.0 - bleeding), 0.0) : 0.0;
}
