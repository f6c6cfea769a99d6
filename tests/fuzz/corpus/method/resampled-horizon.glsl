/* gnomon-method
title = "Horizon resampled from distances"
citation = "this project, after eq. (4) of Onoue, Max & Nishita 2004"
tables = ["height", "distance"]

[parameters.crossings]
default = 48
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

// Eq. (4) of the paper turned round: d is stored and tan β is not, but comes from the height map
// itself, at those distances and in the light's own direction. Nothing is interpolated between
// texels or azimuths, which is what blurs the shadows of horizon maps. What hides the light stands
// mostly near, where the first crossings of the path find it; the table names the few places
// farther on that are worth a look, up to where the ray leaves the relief below it. One blocker is
// enough, so that the first ends the search.

// Where the horizon point of one of the four texels about the pixel, in one of the two azimuths
// about the light's, lies along the path: that texel's own place plus its d, both along e.
// `candidate` is 0 to 7.
float candidateDistance(Pixel pixel, LocalLight light, int candidate) {
  float azimuths = float(textureSize(distanceTable, 0).z);
  vec2 texel = floor(pixel.texel - 0.5) + vec2(candidate & 1, candidate >> 1 & 1);
  int azimuth = int(light.azimuth / (2.0 * pi) * azimuths) + (candidate >> 2);
  float distance = tableEntry(distanceTable, distanceRange, ivec2(texel), azimuth);
  return dot(texel + 0.5 - pixel.texel, light.direction) +
         distance * cos(2.0 * pi * float(azimuth) / azimuths - light.azimuth);
}

bool isShadowed(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, light, range);
  if (shadowedAtStart(path)) return true;
  // The path crosses |e_x| columns and |e_y| rows a texel.
  float close = min(path.limit, crossings / (abs(light.direction.x) + abs(light.direction.y)));
  if (shadowedAtCrossings(path, close)) return true;

  // The candidates, then a search about the best of them, one texel before and after it, then half a one.
  float best = -1e30;
  float bestAt = 0.0;
  float step = 1.0;
  int last = close < path.limit ? 8 + 2 * int(refinements) : 0;
  for (int k = 0; k < last; ++k) {
    float t = k < 8 ? candidateDistance(pixel, light, k) : bestAt + ((k & 1) == 0 ? -step : step);
    if (k >= 8 && (k & 1) != 0) step *= 0.5;
    float found = t > close && t <= path.limit ? excess(path, t) : -1e30;
    if (found >= 0.0) return true;
    if (found > best) {
      best = found;
      bestAt = t;
    }
  }
  return false;
}
