/* gnomon-method
title = "Height map marched on the osculating circle"
citation = "the horizon of one circle a pixel, found by brute force"
tables = ["height"]

[parameters.stride]
default = 0.25
minimum = 0.01
maximum = 8
about = "distance between samples of the height map, texels"
*/

// The height map sampled densely toward the light, every sample standing on the circle that the
// surface follows in that direction: exact but for the stride and for what one circle cannot know of
// the surface. Too slow for a product; it bounds what a
// method can do with h, and with κ and the light at the pixel alone.

bool isShadowed(Pixel pixel, LocalLight light) {
  float curvature = normalCurvature(pixel, light.tangent);     // (1), 1 / world
  float height = pixel.worldPerHeight * heightAt(pixel.texel);  // h₀, world
  if (curvature > 0.0 && !(light.slope > bareHorizon(curvature, height))) return true;  // (3)

  float farthest = min(searchRadius, knownDistance(pixel.texel, light.direction));
  // What no relief reaches is passed over, but for some samples that rounding might miss.
  vec2 above = aboveRelief(curvature, height, light.slope, pixel.worldPerHeight * heightBounds.y) /
               light.worldPerTexel;
  float leaves = above.x * 1.001 + stride;
  float returns = above.y * 0.999 - stride;
  for (float t = stride; t <= farthest; t += stride) {
    if (t > leaves && t < returns) {
      if (returns > farthest) break;
      t = max(t, stride * floor(returns / stride));
    }
    float arcLength = t * light.worldPerTexel;
    float occluder = pixel.worldPerHeight * heightAt(pixel.texel + t * light.direction);
    float slope = (occluder - height) / arcLength;
    if (!(light.slope > osculatingHorizon(curvature, height, slope, arcLength))) return true;
  }
  return false;
}

// Of a disc the march follows the lowest ray and keeps the highest horizon that it meets, until that
// hides the highest ray.
float visibility(Pixel pixel, LocalLight light) {
  float curvature = normalCurvature(pixel, light.tangent);     // (1), 1 / world
  float height = pixel.worldPerHeight * heightAt(pixel.texel);  // h₀, world
  float lowest = lowestRay(light).slope;
  float enough = slopeTurned(light.slope, tan(lightRadius));
  float horizon = lowest;
  if (curvature > 0.0) horizon = max(horizon, bareHorizon(curvature, height));  // (3)

  float farthest = min(searchRadius, knownDistance(pixel.texel, light.direction));
  vec2 above = aboveRelief(curvature, height, lowest, pixel.worldPerHeight * heightBounds.y) /
               light.worldPerTexel;
  float leaves = above.x * 1.001 + stride;
  float returns = above.y * 0.999 - stride;
  for (float t = stride; t <= farthest && horizon < enough; t += stride) {
    if (t > leaves && t < returns) {
      if (returns > farthest) break;
      t = max(t, stride * floor(returns / stride));
    }
    float arcLength = t * light.worldPerTexel;
    float occluder = pixel.worldPerHeight * heightAt(pixel.texel + t * light.direction);
    float slope = (occluder - height) / arcLength;
    horizon = max(horizon, osculatingHorizon(curvature, height, slope, arcLength));
  }
  return shareOver(light.slope, horizon);
}
