/* gnomon-method
title = "Two scales: the relief marched nearby, the body's depth from the light"
citation = "this project"
family = "ours"
symbol = "triangle"
tables = ["height"]
passes = ["light-depth"]
subdivisions = 4
light_mesh = "displaced"
normal = "own"

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
about = "the same, pieces of the displaced mesh; the depth map hides, and the march sees, what is nearer"

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

#include "parts/surface_point.glsl"
#include "parts/light_depth.glsl"
#include "parts/two_scales.glsl"

// The normal of D = P + a h n with all its terms: D_x = P_x + a h_x n + a h n_x. Bump mapping leaves
// out the last, which counts where the relief is as high as the body is thick.
vec3 shadingNormal(Pixel pixel) {
  Cell cell = heightCell(pixel.texel);
  float height = pixel.worldPerHeight * heightIn(cell);
  vec2 rise = pixel.worldPerHeight * gradientIn(cell);
  vec3 alongX = pixel.px + rise.x * pixel.normal + height * turnOfNormal(pixel, pixel.px);
  vec3 alongY = pixel.py + rise.y * pixel.normal + height * turnOfNormal(pixel, pixel.py);
  vec3 facet = normalize(cross(alongX, alongY));
  return dot(facet, pixel.normal) < 0.0 ? -facet : facet;
}

bool isShadowed(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, light);
  float piece = pieceLength();
  vec3 facet = shadingNormal(pixel);
  float cosine = dot(facet, lightDirection);
  return !(cosine > 0.0) || isHiddenAtTwoScales(pixel, light, path, piece, facet, cosine);
}

float visibility(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, lowestRay(light));
  float piece = pieceLength();
  vec3 facet = shadingNormal(pixel);
  float cosine = dot(facet, lightDirection);
  if (!(cosine > -sin(lightRadius))) return 0.0;
  return shareAtTwoScales(pixel, light, path, piece, facet, cosine);
}
