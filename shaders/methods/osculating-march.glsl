/* gnomon-method
title = "Height map marched on the osculating circle"
citation = "the horizon of one circle a pixel, found by brute force"
family = "march"
symbol = "square"
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

struct CircleMarch {
  float curvature;  // (1), 1 / world
  float height;     // h₀, world
  float farthest;   // texels
  float leaves;     // from here on to `returns` the ray is above all relief, texels
  float returns;
};

// The march below a ray at a slope tan θ.
CircleMarch makeCircleMarch(Pixel pixel, LocalLight light, float slope) {
  CircleMarch march;
  march.curvature = normalCurvature(pixel, light.tangent);
  march.height = pixel.worldPerHeight * heightAt(pixel.texel);
  march.farthest = min(searchRadius, knownDistance(pixel.texel, light.direction));
  // What no relief reaches is passed over, but for some samples that rounding might miss.
  vec2 above = aboveRelief(march.curvature, march.height, slope,
                           pixel.worldPerHeight * heightBounds.y) / light.worldPerTexel;
  march.leaves = above.x * 1.001 + stride;
  march.returns = above.y * 0.999 - stride;
  if (march.returns > march.farthest) march.returns = 1e30;
  return march;
}

// The sample to read in place of t: past `farthest` where none is left.
float nextSample(CircleMarch march, float t) {
  bool isAbove = t > march.leaves && t < march.returns;
  return isAbove ? max(t, stride * floor(march.returns / stride)) : t;
}

// The slope tan β′ at which the relief is seen at t.
float seenSlope(Pixel pixel, LocalLight light, CircleMarch march, float t) {
  float arcLength = t * light.worldPerTexel;
  float occluder = pixel.worldPerHeight * heightAt(pixel.texel + t * light.direction);
  float slope = (occluder - march.height) / arcLength;
  return osculatingHorizon(march.curvature, march.height, slope, arcLength);
}

bool isShadowed(Pixel pixel, LocalLight light) {
  CircleMarch march = makeCircleMarch(pixel, light, light.slope);
  bool isBare = march.curvature > 0.0;
  if (isBare && !(light.slope > bareHorizon(march.curvature, march.height))) return true;  // (3)
  for (float t = nextSample(march, stride); t <= march.farthest; t = nextSample(march, t + stride)) {
    if (!(light.slope > seenSlope(pixel, light, march, t))) return true;
  }
  return false;
}

// Of a disc the march follows the lowest ray and keeps the highest horizon that it meets, until that
// hides the highest ray.
float visibility(Pixel pixel, LocalLight light) {
  float lowest = lowestRay(light).slope;
  float enough = slopeTurned(light.slope, tan(lightRadius));
  CircleMarch march = makeCircleMarch(pixel, light, lowest);
  float horizon = lowest;
  if (march.curvature > 0.0) horizon = max(horizon, bareHorizon(march.curvature, march.height));  // (3)
  for (float t = nextSample(march, stride); t <= march.farthest && horizon < enough;
       t = nextSample(march, t + stride)) {
    horizon = max(horizon, seenSlope(pixel, light, march, t));
  }
  return shareOver(light.slope, horizon);
}
