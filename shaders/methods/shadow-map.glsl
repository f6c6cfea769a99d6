/* gnomon-method
title = "Displaced mesh with a shadow map"
citation = "Williams 1978; Reeves, Salesin & Cook 1987"
passes = ["light-depth"]
mesh = "displaced"
subdivisions = 9

[parameters.depth_side]
default = 2048
minimum = 16
maximum = 8192
about = "texels a side of the depth map, which holds the whole surface"

[parameters.samples]
default = 4
minimum = 1
maximum = 32
about = "percentage-closer filtering: samples a side of its square; the papers' 16 are 4 a side"

[parameters.width]
default = 3
minimum = 0
maximum = 64
about = "side of that square, texels of the depth map; 0 samples one point"

[parameters.bias]
default = 1
minimum = 0
maximum = 64
about = "what a sample must be nearer to the light by, texels of the depth map on a facet that faces it"
*/

// The surface as real geometry and its depth seen from the light. Depths around the pixel's place in
// the map are compared one by one, and the pixel is shadowed where more than half of them are nearer to
// the light (percentage-closer filtering gives the share as a soft edge; a mask needs one answer). The
// bias grows with the facet's slope to the light, as the depth does from texel to texel.

bool isShadowed(Pixel pixel, LocalLight light) {
  float cosine = dot(facetNormal(pixel), lightDirection);
  if (!(cosine > 0.0)) return true;
  vec3 place = lightMapPlace(pixel.position);
  float slope = sqrt(max(1.0 - cosine * cosine, 0.0)) / cosine;
  float farthest = 1.0 + 0.5 * width;  // texels from the pixel's place to the farthest sample's far side
  float allowance = lightMapLengths.x * bias * (1.0 + min(slope, 16.0) * farthest * 0.5);
  float depth = place.z - allowance / lightMapLengths.y;
  float nearer = 0.0;
  for (float j = 0.5; j < samples; j += 1.0) {
    for (float i = 0.5; i < samples; i += 1.0) {
      vec2 at = place.xy + width * (vec2(i, j) / samples - 0.5);
      nearer += lightDepthOf(ivec2(floor(at))) < depth ? 1.0 : 0.0;
    }
  }
  return nearer > 0.5 * samples * samples;
}
