/* gnomon-method
title = "Horizon over a pyramid of logarithmic distances"
citation = "Snyder & Nowrouzezahrai 2008"
family = "engine"
symbol = "star"
tables = ["height"]

[bakes.pyramid]
bits = 32
mips = "average"
about = "heights, each level half as fine as the one before"

[parameters.per_octave]
default = 4
minimum = 1
maximum = 64
about = "samples of the height from one distance to twice it"

[parameters.nearest]
default = 1
minimum = 0.01
maximum = 64
about = "distance of the first sample, texels"
*/

// Far blockers need less detail. Along an azimuth heights are sampled at distances that grow by a
// constant factor, from levels of a pyramid that grow as coarse. The blocking angle, as a smooth
// function of the logarithm of the distance, goes through the samples, and its maximum is the horizon.
// Heights of a coarse level are averages: what is narrow and far loses its height.
//
// A light that is small gets three azimuths, its centre's and those of its two sides, between which
// the horizon is linear. Each half of the disc is held against the horizon in its middle.
//
// The paper's abstract could be read, not its text: how many samples, which smooth function and where
// it begins is open. Here a level's texels are as wide as the way to the next sample; the function is a
// Catmull-Rom spline, asked four times between two samples; the receiver's own height is the map's. The paper lights with spherical harmonics of order 4; here the
// horizon is held against the disc by the closed form.

float bakePyramid(vec2 texel) { return heightAt(texel); }

const int between = 4;

// Through b at 0 and c at 1.
float splineAt(float a, float b, float c, float d, float x) {
  return b + 0.5 * x * (c - a + x * (2.0 * a - 5.0 * b + 4.0 * c - d + x * (3.0 * (b - c) + d - a)));
}

// The highest angle of the spline from b to c.
float highestBetween(vec4 angles) {
  float highest = angles.y;
  for (int k = 1; k <= between; ++k) {
    float x = float(k) / float(between);
    highest = max(highest, splineAt(angles.x, angles.y, angles.z, angles.w, x));
  }
  return highest;
}

// The horizon's elevation toward a light, radians.
float horizonToward(Pixel pixel, LocalLight light) {
  float farthest = min(searchRadius, knownDistance(pixel.texel, light.direction));
  float height = heightAt(pixel.texel);
  float factor = exp2(1.0 / per_octave);
  vec4 angles = vec4(-0.5 * pi);  // of the last four samples
  float highest = -0.5 * pi;
  int count = 0;
  for (float t = nearest; t <= farthest; t *= factor) {
    float bump = pyramidAt(pixel.texel + t * light.direction, max(log2(t * (factor - 1.0)), 0.0)) - height;
    float angle = atan(pixel.worldPerHeight * bump, t * light.worldPerTexel);
    angles = count == 0 ? vec4(angle) : vec4(angles.yzw, angle);
    highest = max(highest, highestBetween(angles));
    ++count;
  }
  return max(highest, angles.w);
}

float visibility(Pixel pixel, LocalLight light) {
  float middle = horizonToward(pixel, light);
  if (!(lightRadius > 0.0)) return light.slope > tan(middle) ? 1.0 : 0.0;
  float size = max(dot(light.tangent, light.tangent), 1e-30);
  vec3 across = tan(lightRadius) * cross(pixel.normal, light.tangent) * inversesqrt(size);
  float sum = 0.0;
  for (int side = 0; side < 2; ++side) {
    vec3 toward = normalize(lightDirection + (side == 0 ? across : -across));
    LocalLight edge = makeLocalLight(pixel, toward);
    float horizon = mix(middle, horizonToward(pixel, edge), halfCentre);
    sum += shareOver(light.slope, tan(min(horizon, 1.5707)));
  }
  return 0.5 * sum;
}
