/* gnomon-method
title = "Horizon resampled from distances"
citation = "this project, after eq. (4) of Onoue, Max & Nishita 2004"
family = "ours"
symbol = "square"
tables = ["height", "distance"]

[parameters.crossings]
default = 48
minimum = 1
maximum = 4096
about = "texel crossings sampled before the table is asked"

[parameters.search]
default = 2
minimum = 0
maximum = 16
about = "texels searched before and after each place that the table names"
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
float candidateDistance(Path path, LocalLight light, int candidate) {
  int azimuths = textureSize(distanceTable, 0).z;
  float place = light.azimuth / (2.0 * pi) * float(azimuths);
  vec2 texel = floor(path.start - 0.5) + vec2(candidate & 1, candidate >> 1 & 1);
  float azimuth = floor(place) + float(candidate >> 2);
  float distance = tableEntry(distanceTable, distanceRange, ivec2(texel), int(azimuth));
  float angle = 2.0 * pi * (azimuth - place) / float(azimuths);
  // cos to 9e-4 up to a quarter turn, which four azimuths leave.
  float cosine = 1.0 + angle * angle * (-0.4967 + 0.03705 * angle * angle);
  return dot(texel + 0.5 - path.start, light.direction) + distance * cosine;
}

bool isShadowed(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, light);
  if (shadowedByBareSurface(path)) return true;
  // The path crosses |e_x| columns and |e_y| rows a texel.
  float close = crossings / (abs(light.direction.x) + abs(light.direction.y));

  // The first crossings, then those about each of the candidates. One loop within the other: a
  // software renderer runs the body of every loop at least once.
  Crossings at = firstCrossings(path);
  float end = min(path.limit, close);
  for (int candidate = 0;; ++candidate) {
    if (shadowedAtCrossings(path, at, end)) return true;
    if (candidate == 8 || path.limit <= close) return false;
    float t = candidateDistance(path, light, candidate);
    at = crossingsFrom(path, max(t - search, close));
    end = min(t + search, path.limit);
  }
}

// Of a disc the same places are asked for the highest horizon, along the one or two marches that
// marchesUpTo says.
float horizonOfPlaces(Path path, LocalLight light, float enough, out Crossings at) {
  float horizon = bareSlope(path);
  float close = crossings / (abs(path.direction.x) + abs(path.direction.y));
  at = firstCrossings(path);
  float end = min(path.limit, close);
  for (int candidate = 0;; ++candidate) {
    horizon = horizonAtCrossings(path, at, end, horizon, enough);
    if (candidate == 8 || path.limit <= close || horizon >= enough) return horizon;
    float t = candidateDistance(path, light, candidate);
    at = crossingsFrom(path, max(t - search, close));
    end = min(t + search, path.limit);
  }
}

float visibility(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, lowestRay(light));
  float enough = slopeTurned(light.slope, tan(lightRadius));
  int marches = marchesUpTo(path.limit);
  float sum = 0.0;
  bool isDark = false;  // for both marches, by what hides the disc so near that they meet it together
  for (int march = 0; march < marches && !isDark; ++march) {
    LocalLight to = marchedLight(pixel, light, march, marches);
    Crossings at;
    float share = shareOver(to.slope, horizonOfPlaces(marchedPath(path, to), to, enough, at));
    isDark = share <= 0.0 && marchesUpTo(nextCrossing(at)) == 1;
    sum += share;
  }
  return sum / float(marches);
}
