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

// The normal of D.
vec3 shadingNormal(Pixel pixel) {
  Cell cell = heightCell(pixel.texel);
  float height = pixel.worldPerHeight * heightIn(cell);
  vec2 rise = pixel.worldPerHeight * gradientIn(cell);
#ifdef ON_POLYGONS
  return displacedNormal(pixel, rise, height);
#else
  vec3 facet = normalize(cross(displacedSide(pixel, pixel.px, rise.x, height),
                               displacedSide(pixel, pixel.py, rise.y, height)));
  return dot(facet, pixel.normal) < 0.0 ? -facet : facet;
#endif
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
