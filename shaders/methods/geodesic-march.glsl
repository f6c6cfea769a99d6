/* gnomon-method
title = "Height map marched along the surface's own path"
citation = "this project"
tables = ["height"]

[parameters.range]
default = 128
minimum = 1
maximum = 16384
about = "farthest sample, texels"
*/

// Every crossing of the path with the lines of texel centres, until the ray has left the highest bump
// below it. No table at all.

bool isShadowed(Pixel pixel, LocalLight light) {
  float height = pixel.worldPerHeight * heightAt(pixel.texel);
  Path path = makePath(pixel, light, height, range);
  if (shadowedAtStart(path)) return true;

  Crossings at = firstCrossings(path);
  for (;;) {
    if (excess(path, nextCrossing(at)) >= 0.0) return true;
    pass(at);
    if (nextCrossing(at) > path.limit) break;
  }
  return false;
}
