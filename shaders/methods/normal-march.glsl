/* gnomon-method
title = "Normal mapping shadows"
citation = "Vorontsov 2020"
family = "engine"
symbol = "diamond"
tables = ["height"]

[parameters.samples]
default = 32
minimum = 1
maximum = 4096
about = "samples of the normal map on the way"

[parameters.reach]
default = 0.05
minimum = 0
maximum = 1
about = "how far the march goes for height_scale = 1 and a level light, widths of the map"

[parameters.height_scale]
default = 1.5
minimum = 0
maximum = 100
about = "factor of the reach, and of the share's hardness"

[parameters.hardness]
default = 2
minimum = 0
maximum = 1e6
about = "of the share"
*/

// No height map: -N·L of the normal map is positive where the relief rises faster than the ray, so
// that its sum along the way tells whether the relief has risen over the ray. It is only nearly so,
// since normals have length 1: with the relief's slope s along the light, N·L = (sin θ - s cos θ) /
// √(1 + |∇h|²), and steep flanks count too little.
//
//  - hard: dark where the sum is ever above 0 ("suitable for hard shadow with early exit");
//  - share: each sample at which the sum is the highest so far takes hardness × height_scale ×
//    (1 - its place in widths of the map) / samples from V.
//
// The normals are those of the bilinear relief, exact, and the height map is read for nothing else.
// Numbers are the author's demonstration's. Its dither is left out: samples are in the middle of
// their steps.

// -N·L at a place of the map, in the pixel's frame.
float riseOverRay(Pixel pixel, vec2 at) {
  return -dot(bumpedNormal(pixel, heightGradient(at)), lightDirection);
}

// Widths of the map from one sample to the next, and texels: along e, since the demonstration goes
// the light's way in the plane of the texture.
vec2 stepOf(LocalLight light) {
  float widths = reach * height_scale * length(light.tangent) / samples;
  return vec2(reach / samples, widths * float(textureSize(heightMap, 0).x));
}

bool isShadowed(Pixel pixel, LocalLight light) {
  vec2 each = stepOf(light);
  float known = knownDistance(pixel.texel, light.direction);
  float sum = min(riseOverRay(pixel, pixel.texel), 0.0);
  for (float i = 0.5; i < samples && i * each.y <= known; i += 1.0) {
    sum += riseOverRay(pixel, pixel.texel + i * each.y * light.direction);
    if (sum > 0.0) return true;
  }
  return false;
}

float visibility(Pixel pixel, LocalLight light) {
  vec2 each = stepOf(light);
  float known = knownDistance(pixel.texel, light.direction);
  float sum = min(riseOverRay(pixel, pixel.texel), 0.0);
  float highest = 0.0;
  float hidden = 0.0;
  for (float i = 0.5; i < samples && i * each.y <= known; i += 1.0) {
    sum += riseOverRay(pixel, pixel.texel + i * each.y * light.direction);
    if (sum > highest) hidden += hardness * height_scale * (1.0 - i * each.x);
    highest = max(highest, sum);
  }
  return clamp(1.0 - hidden / samples, 0.0, 1.0);
}
