/* gnomon-method
title = "Height map marched along the surface's own path"
citation = "this project"
family = "ours"
symbol = "circle"
tables = ["height"]

[parameters.own_slope]
default = 0
minimum = 0
maximum = 1
about = "1: an attached shadow of its own, exact on the osculating circle, beside the bumped normal's"
*/

// Every crossing of the path with the lines of texel centres, until the ray has left the highest
// bump below it. No table at all.

bool isShadowed(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, light);
  return shadowedByBareSurface(path) || (own_slope > 0.5 && shadowedByOwnSlope(path)) ||
         shadowedAtCrossings(path, path.limit);
}

// Of a disc the march follows the lowest ray, keeps the highest horizon that it meets, and ends where
// that hides the highest ray.
float visibility(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, lowestRay(light));
  float lowest = bareSlope(path);
  if (own_slope > 0.5) {
    lowest = max(lowest, osculatingHorizon(path.curvature, path.height, path.rise, 0.0));
  }
  return shareAtCrossings(pixel, light, path, path.limit, lowest);
}
