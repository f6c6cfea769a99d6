/* gnomon-method
title = "Two scales: the relief marched nearby, the body's depth from the light"
citation = "this project"
family = "ours"
symbol = "triangle"
subdivisions = 4
light_mesh = "displaced"
normal = "own"
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
