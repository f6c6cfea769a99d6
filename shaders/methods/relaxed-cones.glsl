/* gnomon-method
title = "Relaxed cone stepping"
citation = "Policarpo & Oliveira 2007"
family = "march"
symbol = "pentagon"
tables = ["height"]

[bakes.cone]
bits = 8
about = "the widest relaxed cone over a texel: widths of the map over the height's range"

[parameters.steps]
default = 15
minimum = 1
maximum = 4096
type = "int"
about = "steps from where the light enters the relief toward the point"

[parameters.halvings]
default = 6
minimum = 0
maximum = 24
type = "int"
about = "steps of the binary search after them"

[parameters.allowance]
default = 0.05
minimum = 0
maximum = 1
about = "how far over the point the ray must meet the relief to be hidden, share of the height's range"
*/

// A cone of cone-steps holds no relief. A relaxed one may: over a texel it is the widest in which a ray
// that comes down pierces the relief at most once, so that rays may step into the relief and a binary
// search finds where they entered it. From the light's side of the relief the ray goes, at the height
// z over the map, to the side of the cone that it is in, and within the relief it stays:
//   t -= c max(z - h, 0) / (1 + c r),   c the cone's radius per height, r the ray's fall per texel.
// The point is dark where the place that is found stands higher than the point. As all rays of the
// source it comes from above: a light below the plane of the texture leaves all dark.
//
// The chapter's listings could be read in programs that hold them (GPU Gems 3, chapter 18): 15 steps, 6
// halvings, cones of at most 1 in 8 bits, depths and cones through the texture's linear filter, and the
// rays of the bake. It shows no shadow test: the one here is that of the authors' relief mapping of
// 2005, which compares the depth that the light's ray meets with the point's, 0.05 of the range aside.

const int coneAzimuths = 64;
const float coneStride = 1.0;  // texels

// Of a cone of 1: texels per height unit.
float wholeCone() { return max(mapSize.x, mapSize.y) / max(heightBounds.y - heightBounds.x, 1e-20); }

// The source's rays begin over the texel at the relief's top, pass through every other texel's height
// and go on to where they leave the relief; the cone has that place on its side at the least. With h₀
// the texel's height and H the top, a ray of the fall m is within the relief at the distance r where
// m ≥ g(r) = (H - h(r)) / r, so that rays leave it where g grows, where the relief turns away from the
// place over the texel. There the cone is c = r / (h(r) - h₀). Rays that begin lower may leave the
// relief sooner: like the source's, these cones are not for them.
float bakeCone(vec2 texel) {
  float height = heightAt(texel);
  float room = heightBounds.y - height;
  float steepest = 1.0 / wholeCone();
  for (int m = 0; m < coneAzimuths; ++m) {
    float azimuth = 2.0 * pi * float(m) / float(coneAzimuths);
    vec2 toward = vec2(cos(azimuth), sin(azimuth));
    float end = knownDistance(texel, toward);
    float over = 0.0;     // h(r) - h₀ of the last sample
    float fall = 1e30;    // and its g(r)
    // What is farther than room / steepest is not over the cone that there is.
    for (float r = coneStride; r <= end && (r - coneStride) * steepest < room; r += coneStride) {
      float next = heightAt(texel + r * toward) - height;
      float nextFall = (room - next) / r;
      if (nextFall > fall) steepest = max(steepest, over / (r - coneStride));
      over = next;
      fall = nextFall;
    }
  }
  return 1.0 / (steepest * wholeCone());
}

bool isShadowed(Pixel pixel, LocalLight light) {
  float height = heightAt(pixel.texel);
  // Fall of the ray, height units per texel.
  float fall = light.slope * light.worldPerTexel / pixel.worldPerHeight;
  if (!(fall > 0.0)) return true;
  float known = min(searchRadius, knownDistance(pixel.texel, light.direction));
  float far = min(known, (heightBounds.y - height) / fall);
  float near = far;  // texels from the point
  for (int i = 0; i < steps; ++i) {
    vec2 at = pixel.texel + near * light.direction;
    float over = max(height + fall * near - heightAt(at), 0.0);
    float cone = coneAt(at) * wholeCone();
    near -= cone * over / (1.0 + cone * fall);
  }
  // Where the ray enters the relief, of which `near` is the inside.
  for (int i = 0; i < halvings; ++i) {
    float t = 0.5 * (near + far);
    bool isOutside = height + fall * t > heightAt(pixel.texel + t * light.direction);
    far = isOutside ? t : far;
    near = isOutside ? near : t;
  }
  return fall * 0.5 * (near + far) > allowance * (heightBounds.y - heightBounds.x);
}
