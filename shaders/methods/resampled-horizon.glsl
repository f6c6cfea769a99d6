/* gnomon-method
title = "Horizon resampled from distances"
citation = "this project, after eq. (4) of Onoue, Max & Nishita 2004"
tables = ["height", "distance"]

[parameters.crossings]
default = 24
minimum = 1
maximum = 4096
about = "texel crossings sampled before the table is asked"

[parameters.refinements]
default = 2
minimum = 0
maximum = 16
about = "steps of the search about the best candidate, from 1 texel, each half the one before"

[parameters.range]
default = 128
minimum = 1
maximum = 16384
about = "farthest sample, texels"
*/

bool isShadowed(Pixel pixel, LocalLight light) {
  float height = pixel.worldPerHeight * heightAt(pixel.texel);
  Path path = makePath(pixel, light, height, range);
  if (shadowedAtStart(path)) return true;

  Crossings at = firstCrossings(path);
  float close = min(path.limit, crossings / (abs(light.direction.x) + abs(light.direction.y)));
  for (;;) {
    if (excess(path, nextCrossing(at)) >= 0.0) return true;
    pass(at);
    if (nextCrossing(at) > close) break;
  }
  if (close >= path.limit) return false;

  ivec3 size = textureSize(distanceTable, 0);
  float place = light.azimuth / (2.0 * pi) * float(size.z);
  int below = int(place);
  vec2 corner = floor(pixel.texel - 0.5);
  ivec2 i = wrapTexel(ivec2(corner), size.xy);
  ivec2 j = wrapTexel(ivec2(corner) + 1, size.xy);
  float best = -1e30;
  float bestAt = 0.0;
  for (int candidate = 0; candidate < 8; ++candidate) {
    ivec2 side = ivec2(candidate & 1, candidate >> 1 & 1);
    int azimuth = below + (candidate >> 2);
    ivec3 entry = ivec3(side.x > 0 ? j.x : i.x, side.y > 0 ? j.y : i.y,
                        azimuth < size.z ? azimuth : azimuth - size.z);
    float distance = distanceRange.x + distanceRange.y * texelFetch(distanceTable, entry, 0).r;
    float angle = 2.0 * pi * float(azimuth) / float(size.z);
    vec2 top = corner + 0.5 + vec2(side) + distance * vec2(cos(angle), sin(angle));
    float t = dot(top - pixel.texel, light.direction);
    if (t > close && t <= path.limit) {
      float found = excess(path, t);
      if (found >= 0.0) return true;
      if (found > best) {
        best = found;
        bestAt = t;
      }
    }
  }
  float step = 1.0;
  for (float k = 0.0; k < refinements; k += 1.0) {
    float before = excess(path, bestAt - step);
    float after = excess(path, bestAt + step);
    float found = max(before, after);
    if (bestAt > 0.0 && found >= 0.0) return true;
    if (found > best) {
      bestAt += after >= before ? step : -step;
      best = found;
    }
    step *= 0.5;
  }
  return false;
}
