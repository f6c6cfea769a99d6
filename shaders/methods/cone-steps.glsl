/* gnomon-method
title = "Cone step mapping"
citation = "Dummer 2006"
family = "march"
symbol = "diamond"
tables = ["height", "horizon"]

[bakes.cone]
bits = 8
about = "square root of the widest cone over a texel that holds no relief: widths of the map over the height's range"

[parameters.steps]
default = 32
minimum = 1
maximum = 4096
about = "steps from where the light enters the relief down to the point"

[parameters.bias]
default = 0.5
minimum = 0
maximum = 64
about = "how near the ray must come to the point to be its own, texels"
*/

// Over every texel stands an open cone that holds no relief. A ray that comes down from the light at
// the height z over the map goes on to the side of the cone that it is in:
//   t = c (z - h) / (1 + c r),   c the cone's radius per height, r the ray's fall per texel.
// It is stopped where it meets the relief. Steps are safe, and shrink toward what they meet, so that
// there is no stride to choose; a ray that has not come to the point when steps run out has met
// something else.
//
// The text's beginning could be read, and programs that follow it. The cone is that of the steepest
// horizon in the azimuths of the tables, where Dummer compares every texel with every other. It is
// stored as programs do: the square root, in 8 bits, for a map of width 1 and heights from 0 to 1.
// Between texels cones are interpolated as by those programs' linear filter, which is not safe where a
// summit a texel wide, whose own cone is wide, stands beside a steep flank (Bán et al. 2024): rays jump
// over it. How many steps and how near is left open.

// Of a cone of 1: texels per height unit.
float wholeCone() { return max(mapSize.x, mapSize.y) / max(heightBounds.y - heightBounds.x, 1e-20); }

float bakeCone(vec2 texel) {
  int azimuths = textureSize(horizonTable, 0).z;
  float steepest = 0.0;
  for (int m = 0; m < azimuths; ++m) {
    steepest = max(steepest, tableEntry(horizonTable, horizonRange, ivec2(floor(texel)), m));
  }
  return sqrt(min(1.0 / max(steepest * wholeCone(), 1e-20), 1.0));
}

bool isShadowed(Pixel pixel, LocalLight light) {
  float height = heightAt(pixel.texel);
  // Fall of the ray, height units per texel.
  float fall = light.slope * light.worldPerTexel / pixel.worldPerHeight;
  float far = min(searchRadius, knownDistance(pixel.texel, light.direction));
  if (fall > 0.0) far = min(far, (heightBounds.y - height) / fall);
  float t = far;  // texels from the point
  for (float i = 0.0; i < steps && t > bias; i += 1.0) {
    vec2 at = pixel.texel + t * light.direction;
    float over = height + fall * t - heightAt(at);
    if (over < 0.0) return true;
    float root = coneAt(at);
    float cone = root * root * wholeCone();
    float along = 1.0 + cone * fall;
    // A ray that rises faster than the cone's side, seen from the light, never leaves it.
    t = along > 0.0 ? t - cone * over / along : 0.0;
  }
  return t > bias;
}
