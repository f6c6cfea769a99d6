/* gnomon-method
title = "Two scales, the near one marched over maps of the surface"
citation = "this project"
family = "ours"
symbol = "diamond"
subdivisions = 4
light_mesh = "displaced"
normal = "own"
*/

// surface-march sees all of the relief that a ray can meet, unless the maps end before: at a chart's
// border or in a fold. There two-scales answers. Elsewhere only another part of the body can still hide
// the light, which the depth map sees farther away than the march knows, by more than what such a map is
// off by (A in parts/two_scales.glsl).

#include "parts/surface_point.glsl"
#include "parts/surface_march.glsl"
#include "parts/light_depth.glsl"
#include "parts/two_scales.glsl"

bool isShadowed(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, light);
  float piece = pieceLength();
  vec3 facet = shadingNormal(pixel);
  float cosine = dot(facet, lightDirection);
  if (!(cosine > 0.0)) return true;
  float slope;
  March march = marchToward(pixel, lightDirection, slope);
  if (march.horizon >= slope) return true;
  if (!march.isWhole) return isHiddenAtTwoScales(pixel, light, path, piece, facet, cosine);
  DepthPlace at = depthPlaceOf(pixel, light, path, piece, facet, cosine);
  at.place.z -= march.known / lightMapLengths.y;
  return shareNearer(at.place, at.tilt) > 0.5;
}

// The smaller of the march's share and the depth map's.
float visibility(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, lowestRay(light));
  float piece = pieceLength();
  vec3 facet = shadingNormal(pixel);
  float cosine = dot(facet, lightDirection);
  if (!(cosine > -sin(lightRadius))) return 0.0;
  March found;
  float share = shareMarched(pixel, light, found);
  if (share <= 0.0) return 0.0;
  if (!found.isWhole) return min(share, shareAtTwoScales(pixel, light, path, piece, facet, cosine));
  DepthPlace at = depthPlaceOf(pixel, light, path, piece, facet, cosine);
  float beyond = found.known / lightMapLengths.y;
  float reach = tan(lightRadius) * lightMapLengths.y / lightMapLengths.x;  // texels, of depth 1
  float blocker = blockerDistances(at.place, at.tilt, reach, beyond).x;
  at.place.z -= beyond;
  return min(share, shareByDepth(at.place, at.tilt, reach * blocker));
}
