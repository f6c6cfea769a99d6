/* gnomon-method
title = "Height map marched under the ray, over maps of the surface"
citation = "this project"
family = "ours"
symbol = "pentagon"
subdivisions = 4
normal = "own"
*/

// Where another chart has the texels, the pixel's own frame is what is left: the rest of the march is
// that of geodesic-march.

#include "parts/surface_point.glsl"
#include "parts/surface_march.glsl"

bool isShadowed(Pixel pixel, LocalLight light) {
  Path path;
  if (chartsOverlap) path = makePath(pixel, light);
  if (!(dot(shadingNormal(pixel), lightDirection) > 0.0)) return true;
  float slope;
  March march = marchToward(pixel, lightDirection, slope);
  if (march.horizon >= slope || march.isWhole || !hasMetOtherChart) return march.horizon >= slope;
  return shadowedByBareSurface(path) || shadowedAtCrossings(path, path.limit);
}

float visibility(Pixel pixel, LocalLight light) {
  Path path;
  if (chartsOverlap) path = makePath(pixel, lowestRay(light));
  if (!(dot(shadingNormal(pixel), lightDirection) > -sin(lightRadius))) return 0.0;
  March march;
  float share = shareMarched(pixel, light, march);
  if (share <= 0.0 || march.isWhole || !hasMetOtherChart) return share;
  return min(share, shareAtCrossings(pixel, light, path, path.limit, bareSlope(path)));
}
