/* gnomon-method
title = "Two scales, the near one marched over maps of the surface"
citation = "this project"
family = "ours"
symbol = "diamond"
subdivisions = 4
light_mesh = "displaced"
normal = "own"
*/

// surface-march sees all of the relief that a ray can meet, unless the maps end before: at a chart's border
// or in a fold. From there the march goes on as that of two-scales does, as far as the depth map may be off
// and to the border of the chart. What else hides the light the depth map sees: all but what the march has
// passed over and knows better.

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
  DepthPlace at = depthPlaceOf(pixel, light, path, piece, facet, cosine);
  float from = march.known * at.near / at.allowance;
  float near = min(at.near, path.limit);
  if (!march.isWhole && from < near &&
      shadowedAtCrossings(path, crossingsFrom(path, from), endOnChart(pixel, path, near))) {
    return true;
  }
  at.end = march.at.xy;
  return shareNearer(at) > 0.5;
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
  DepthPlace at = depthPlaceOf(pixel, light, path, piece, facet, cosine);
  at.end = found.at.xy;
  if (!found.isWhole) {
    float near = endOnChart(pixel, path, min(at.near, path.limit));
    share = min(share, shareAtCrossings(pixel, light, path, near, bareSlope(path)));
  }
  float reach = tan(lightRadius) * lightMapLengths.y / lightMapLengths.x;  // texels, of depth 1
  return min(share, shareByDepth(at, reach * blockerDistances(at, reach).x));
}
