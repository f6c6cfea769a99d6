/* gnomon-method
title = "Distance to the next step of the ground, resolved over the texture"
citation = "the tests of this project"
tables = ["height"]

[bakes.ground]
channels = 2
bits = 16
range = [[0, 64], [0, 16]]
layers = 4
filter = "nearest"
about = "way to the next higher ground toward +x, +y, -x and -y, texels, and by how much it is higher"

[parameters.reach]
default = 40
minimum = 1
maximum = 64
type = "int"
about = "texels that are looked at"

[[pass]]
name = "dark"
kind = "texture"
bits = 8
about = "1 where the ground is higher than the ray to the light"

[[pass]]
name = "clean"
kind = "filter"
of = "dark"
bits = 8
about = "what most of nine texels say"
*/

// For lights along an axis of the map, over ground that has steps and is flat elsewhere: the manual's
// ways to bring something, each used once. Written from docs/adding-a-method.md alone.

#include "parts/steps.glsl"

vec2 bakeGround(vec2 texel, int layer) { return nextStep(texel, axisOf(layer), reach); }

float passDark(Pixel pixel) {
  LocalLight light = makeLocalLight(pixel, lightDirection);
  vec2 step = groundTexel(ivec2(floor(pixel.texel)), layerOf(light.azimuth));
  float slope = pixel.worldPerHeight * step.y / (light.worldPerTexel * max(step.x, 0.5));
  return step.y > 0.0 && slope > light.slope ? 1.0 : 0.0;
}

float passClean(ivec2 texel) {
  float sum = 0.0;
  for (int k = 0; k < 9; ++k) sum += darkTexel(texel + ivec2(k % 3 - 1, k / 3 - 1));
  return sum > 4.5 ? 1.0 : 0.0;
}

bool isShadowed(Pixel pixel, LocalLight light) { return cleanAt(pixel.texel) > 0.5; }
