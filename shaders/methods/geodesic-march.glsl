/* gnomon-method
title = "Height map marched along the surface's own path"
citation = "this project"
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
