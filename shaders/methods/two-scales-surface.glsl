/* gnomon-method
title = "Two scales, the near one marched over maps of the surface"
citation = "this project"
family = "ours"
symbol = "diamond"
tables = ["height"]
passes = ["light-depth"]
subdivisions = 4
light_mesh = "displaced"
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

[parameters.light_pieces]
default = 9
minimum = 1
maximum = 1024
about = "pieces of every face's side of the displaced mesh that the light sees"

[parameters.depth_side]
default = 2048
minimum = 16
maximum = 8192
about = "texels a side of the depth map, which holds the whole surface"

[parameters.bias]
default = 1
minimum = 0
maximum = 64
about = "how far places on the displaced mesh may be off, texels of the depth map, beside piece_bias"

[parameters.piece_bias]
default = 0.5
minimum = 0
maximum = 16
about = "the same, pieces of the displaced mesh; the depth map hides what is nearer"

[parameters.edge]
default = 0.25
minimum = 0
maximum = 16
about = "how far from the outlines of its shadows the depth map asks the march, pieces; a texel at least"

[parameters.trust]
default = 0.03
minimum = 0
maximum = 1
about = "the march overrules the depth map where its path errs less than this part of what the map may be off"

[parameters.search_samples]
default = 24
minimum = 1
maximum = 1024
about = "soft light: texels of the depth map that are asked for what hides some of the light"

[parameters.filter_samples]
default = 16
minimum = 1
maximum = 1024
about = "soft light: texels of the depth map that the share is taken of"
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
