/* gnomon-method
title = "Height map marched under the ray, over maps of the surface"
citation = "this project"
family = "ours"
symbol = "pentagon"
subdivisions = 4
normal = "own"
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
