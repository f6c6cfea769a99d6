/* gnomon-method
title = "Height map marched under the ray, over maps of the surface"
citation = "this project"
family = "ours"
symbol = "pentagon"
tables = ["height"]
subdivisions = 4
normal = "own"

[[pass]]
name = "point"
kind = "texture"
channels = 3
about = "P, world"

[[pass]]
name = "column"
kind = "texture"
channels = 3
about = "a n, world: what a height unit adds to P"

[parameters.leg]
default = 2
minimum = 0.25
maximum = 16
about = "longest part of the way between two of its places that are solved for, texels"
*/

#include "parts/surface_point.glsl"
#include "parts/surface_march.glsl"

bool isShadowed(Pixel pixel, LocalLight light) {
  if (!(dot(shadingNormal(pixel), lightDirection) > 0.0)) return true;
  float slope;
  March march = marchToward(pixel, lightDirection, slope);
  return march.horizon >= slope;
}

float visibility(Pixel pixel, LocalLight light) {
  if (!(dot(shadingNormal(pixel), lightDirection) > -sin(lightRadius))) return 0.0;
  March march;
  return shareMarched(pixel, light, march);
}
