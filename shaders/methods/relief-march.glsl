/* gnomon-method
title = "Height map marched toward the light"
citation = "as engines do, after Tatarchuk 2006"
tables = ["height"]

[parameters.steps]
default = 64
minimum = 1
maximum = 4096
about = "samples of the height map on the way to the light"
*/

// What engines ship: the ray to the light over the flat relief, sampled at even steps until it has
// left the highest bump below it, or as far as is searched where it never does.

bool isShadowed(Pixel pixel, LocalLight light) {
  float height = heightAt(pixel.texel);
  // Rise of the ray, height units per texel.
  float rise = light.slope * light.worldPerTexel / pixel.worldPerHeight;
  float farthest = min(searchRadius, knownDistance(pixel.texel, light.direction));
  float end = rise > 0.0 ? min((heightBounds.y - height) / rise, farthest) : farthest;
  for (float i = 1.0; i <= steps; i += 1.0) {
    float t = end * i / steps;
    if (heightAt(pixel.texel + t * light.direction) > height + rise * t) return true;
  }
  return false;
}

// Of a disc the march follows the lowest ray and keeps the highest slope that it meets.
float visibility(Pixel pixel, LocalLight light) {
  float height = heightAt(pixel.texel);
  float scale = pixel.worldPerHeight / light.worldPerTexel;
  float horizon = lowestRay(light).slope / scale;  // height units per texel
  float farthest = min(searchRadius, knownDistance(pixel.texel, light.direction));
  float end = horizon > 0.0 ? min((heightBounds.y - height) / horizon, farthest) : farthest;
  for (float i = 1.0; i <= steps; i += 1.0) {
    float t = max(end * i / steps, 1e-3);
    horizon = max(horizon, (heightAt(pixel.texel + t * light.direction) - height) / t);
  }
  return shareOver(light.slope, scale * horizon);
}
