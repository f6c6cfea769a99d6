/* gnomon-method
title = "Displaced mesh with a shadow map"
citation = "Williams 1978; Reeves, Salesin & Cook 1987; Fernando 2005"
family = "displaced"
symbol = "square"
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

[parameters.search_samples]
default = 16
minimum = 1
maximum = 1024
about = "soft light: samples of the search for blockers; NVIDIA's integration paper of 2008 has 16"

[parameters.filter_samples]
default = 16
minimum = 1
maximum = 1024
about = "soft light: samples of the filter; NVIDIA's integration paper of 2008 has 16"
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

// Percentage-closer soft shadows (Fernando 2005), three steps. The blockers among samples of the
// widest region that can matter have a mean depth; by it the penumbra here is 2 tan ρ × (receiver -
// blocker) wide, since the light is as far from all of them; percentage-closer filtering with that
// width is V. The paper's light has a size and a place, this one an angle. Its samples are on a
// spiral, the same for every pixel, so that the picture has no noise; their number in the text of
// 2005 is not known to us.

// Samples are compared with the plane of the pixel's facet, which a wide region would shade by itself
// else; the bias is the hard test's for a texel.

// Number and summed depth of what is nearer among samples of a disc, `across` texels wide.
vec2 blockersWithin(vec3 place, vec2 tilt, float across, int count) {
  vec2 sum = vec2(0.0);
  vec2 toward = vec2(0.5 * across, 0.0);
  for (int k = 0; k < count; ++k) {
    vec2 texel = floor(place.xy + sqrt((float(k) + 0.5) / float(count)) * toward);
    toward = goldenTurn(toward);
    float depth = lightDepthOf(ivec2(texel));
    bool isNearer = depth < place.z + dot(tilt, texel + 0.5 - place.xy);
    sum += isNearer ? vec2(1.0, depth) : vec2(0.0);
  }
  return sum;
}

float visibility(Pixel pixel, LocalLight light) {
  vec3 facet = facetNormal(pixel);
  float cosine = dot(facet, lightDirection);
  float facing = max(cosine, 1.0 / 16.0);
  vec3 place = lightMapPlace(pixel.position);
  vec2 tilt = lightMapTilt(facet, facing);
  float slope = sqrt(max(1.0 - facing * facing, 0.0)) / facing;
  place.z -= lightMapLengths.x * bias * (1.0 + 0.5 * slope) / lightMapLengths.y;
  float widest = 2.0 * tan(lightRadius) * lightMapLengths.y / lightMapLengths.x;  // texels, of depth 1
  vec2 blockers = blockersWithin(place, tilt, max(widest * place.z, 1.0), int(search_samples));
  float depth = blockers.y / max(blockers.x, 1.0);
  float penumbra = max(widest * (place.z - depth), 1.0);
  float hidden = blockersWithin(place, tilt, penumbra, int(filter_samples)).x / floor(filter_samples);
  float share = blockers.x > 0.0 ? 1.0 - hidden : 1.0;
  return cosine > -sin(lightRadius) ? share : 0.0;
}
