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

// How far the first crossings go, texels: the path crosses |e_x| columns and |e_y| rows a texel.
float closeTo(Path path) { return crossings / (abs(path.direction.x) + abs(path.direction.y)); }

bool isShadowed(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, light);
  if (shadowedByBareSurface(path)) return true;
  float close = closeTo(path);

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

// Of a disc the same places are asked for the highest horizon, from the crossing `start` on.
float horizonOfPlaces(Path path, LocalLight light, float start, float lowest, float enough) {
  float horizon = lowest;
  float close = closeTo(path);
  Crossings at = crossingsFrom(path, start);
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
  // Near the pixel one march serves both halves of the disc, and on a short way all along.
  float together = min(min(path.limit, closeTo(path)), parting());
  Crossings at = firstCrossings(path);
  float horizon = horizonAtCrossings(path, at, together, bareSlope(path), enough);
  if (path.limit <= together || horizon >= enough) return shareOver(light.slope, horizon);
  int marches = path.limit > parting() ? 2 : 1;
  float sum = 0.0;
  for (int side = 0; side < marches; ++side) {
    LocalLight to = light;
    if (marches == 2) to = halfLight(pixel, light, side);
    sum += shareOver(to.slope, horizonOfPlaces(pathToward(path, to), to, together, horizon, enough));
  }
  return sum / float(marches);
}
