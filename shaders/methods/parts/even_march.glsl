/* gnomon-part
tables = ["height"]

[parameters.steps]
default = 64
minimum = 1
maximum = 4096
about = "samples of the height map on the way to the light"
*/

// The height map at even steps on the way to the light: over the flat relief, as far as the ray is below
// the highest bump, or as far as is searched where it never leaves it.

// Height units per texel.
float riseOf(Pixel pixel, LocalLight light) {
  return light.slope * light.worldPerTexel / pixel.worldPerHeight;
}

// How far a ray of that rise is marched, texels.
float endOf(Pixel pixel, LocalLight light, float height, float rise) {
  float farthest = min(searchRadius, knownDistance(pixel.texel, light.direction));
  return rise > 0.0 ? min((heightBounds.y - height) / rise, farthest) : farthest;
}

bool shadowedOnTheWay(Pixel pixel, LocalLight light) {
  float height = heightAt(pixel.texel);
  float rise = riseOf(pixel, light);
  float end = endOf(pixel, light, height, rise);
  for (float i = 1.0; i <= steps; i += 1.0) {
    float t = end * i / steps;
    if (heightAt(pixel.texel + t * light.direction) > height + rise * t) return true;
  }
  return false;
}

// Of a disc the march follows the lowest ray and keeps the highest slope that it meets.
float shareOnTheWay(Pixel pixel, LocalLight light) {
  float height = heightAt(pixel.texel);
  float scale = pixel.worldPerHeight / light.worldPerTexel;
  float horizon = lowestRay(light).slope / scale;
  float end = endOf(pixel, light, height, horizon);
  for (float i = 1.0; i <= steps; i += 1.0) {
    float t = max(end * i / steps, 1e-3);
    horizon = max(horizon, (heightAt(pixel.texel + t * light.direction) - height) / t);
  }
  return shareOver(light.slope, scale * horizon);
}
