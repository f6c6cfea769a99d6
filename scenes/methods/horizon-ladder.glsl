/* gnomon-method
title = "Horizon and distance maps, their approximations as switches"
citation = "after Max 1988; Forsyth 2003; Onoue, Max & Nishita 2004"
tables = ["height", "horizon", "distance"]

[parameters.curved]
default = 1
minimum = 0
maximum = 1
about = "0: the surface counts as flat; 1: curvature by (1), (2), (3)"

[parameters.resampled]
default = 0
minimum = 0
maximum = 1
about = "0: tables linear in three axes; 1: unfiltered distances, heights from the map itself"

[parameters.ruling]
default = 0
minimum = 0
maximum = 1
about = "0: the flat relief's horizon point; 1: the one that rules at the surface's curvature"

[parameters.angles]
default = 0
minimum = 0
maximum = 1
about = "0: small angles, as (2); 1: sines and cosines"

[parameters.denominator]
default = 0
minimum = 0
maximum = 1
about = "0: the occluder's rise left out of the denominator; 1: kept"

[parameters.along]
default = 0
minimum = 0
maximum = 1
about = "0: curvature at the pixel, straight lines in the map; 1: along the surface's own path"

[parameters.levels]
default = 255
minimum = 0
maximum = 65535
about = "codes less one of an entry of the tables that `ruling` makes; 0 for floats"
*/

// One method, every approximation of which can be undone by itself: what an error budget needs.
// As it is by default it is onoue-2004; with `curved` off max-forsyth; with `angles` and
// `denominator` onoue-exact; and with everything on geodesic-march: it gives the same masks as
// those. The switches are 0 or 1.

bool isOn(float value) { return value > 0.5; }

// A horizon as the tables hold it.
struct Horizon {
  float delta;     // slope over the flat relief, height units per texel
  float distance;  // d, texels
};

// World slope of the flat relief at a horizon, with the growth of the height's unit on the way.
float flatSlope(Path path, Horizon horizon) {
  float units = path.height / path.scale + horizon.delta * horizon.distance;
  return path.scale * horizon.delta / path.worldPerTexel +
         path.growth * units / path.worldPerTexel;
}

// The paper's form before its small-angle step, with H = d tan β and R = 1 / κ:
//   tan β′ = (H cos γ - 2 (R + h) sin²(γ/2)) / (2 (R + h) sin(γ/2) cos(γ/2)),
// times κ above and below. The exact one has H sin γ more in its denominator.
float unreducedHorizon(float curvature, float height, float slope, float reach) {
  float angle = curvature * reach;
  if (abs(angle) > 0.5 * pi) return -1e9;
  float ground = max(1.0 + curvature * height, 1e-3);
  if (abs(angle) < 1e-4) return slope / ground - 0.5 * angle;
  float sineOfHalf = sin(0.5 * angle);
  return (slope * angle * cos(angle) / ground - 2.0 * sineOfHalf * sineOfHalf) / sin(angle);
}

// tan β′ of a horizon.
float seenSlope(Path path, Horizon horizon) {
  float slope = flatSlope(path, horizon);
  float reach = horizon.distance * path.worldPerTexel;
  float curvature = path.curvature + horizon.distance * path.turn;
  if (isOn(angles)) {
    if (isOn(denominator)) return osculatingHorizon(curvature, path.height, slope, reach);
    return unreducedHorizon(curvature, path.height, slope, reach);
  }
  // The exact form to first order in κ has the occluder's height where (2) has the pixel's.
  float height = path.height + (isOn(denominator) ? slope * reach : 0.0);
  return slope * (1.0 - curvature * height) - 0.5 * curvature * reach;  // (2)
}

// The horizon at t on the path.
Horizon horizonOf(Path path, float t) {
  return Horizon((heightAt(pathPoint(path, t)) - path.height / path.scale) / t, t);
}

// The limit r → 0⁺: the slope on which the path begins.
Horizon startOf(Path path) {
  vec2 gradient = heightGradient(path.start + 1e-3 * path.direction);
  return Horizon(dot(gradient, path.direction), 0.0);
}

// No occluder at t or farther is seen higher than this over a surface that is nowhere concave:
// each of the formulas falls with the distance and is largest for the relief's highest point.
float highestFrom(Path path, float low, float t) {
  float reach = t * path.worldPerTexel;
  float angle = min(low * reach, 0.5 * pi);
  float rise = max((path.scale + abs(path.growth) * t) * heightBounds.y - path.height, 0.0);
  float ground = clamp(1.0 + path.curvature * path.height, 0.1, 1.0);
  return rise / (reach * ground) * (angle > 1e-4 ? angle / sin(angle) : 1.0) - 0.5 * angle;
}

// Of the path's horizons the one that is seen highest.
Horizon rulingOf(Path path) {
  Horizon best = startOf(path);
  float highest = seenSlope(path, best);
  float end = pathEnd(path);
  float low = min(path.curvature, path.curvature + end * path.turn);
  Crossings at = firstCrossings(path);
  for (float t = nextCrossing(at); t <= end; t = nextCrossing(at)) {
    if (low >= 0.0 && path.growth == 0.0 && highestFrom(path, low, t) < highest) break;
    Horizon found = horizonOf(path, t);
    float seen = seenSlope(path, found);
    if (seen > highest) {
      highest = seen;
      best = found;
    }
    pass(at);
  }
  return best;
}

float stored(float value, vec2 tableRange) {
  if (levels < 1.0) return value;
  float step = tableRange.y / levels;
  return step > 0.0 ? tableRange.x + step * floor((value - tableRange.x) / step + 0.5) : value;
}

// What the tables would hold had they been baked at this pixel's curvature, read as they are:
// linear between four texels and two azimuths.
Horizon rulingAt(Path path, LocalLight light) {
  int azimuths = textureSize(horizonTable, 0).z;
  float place = light.azimuth / (2.0 * pi) * float(azimuths);
  vec2 corner = floor(path.start - 0.5);
  vec2 fraction = path.start - 0.5 - corner;
  Horizon sum = Horizon(0.0, 0.0);
  for (int k = 0; k < 8; ++k) {
    vec3 step = vec3(k & 1, k >> 1 & 1, k >> 2);
    vec3 along = mix(1.0 - vec3(fraction, fract(place)), vec3(fraction, fract(place)), step);
    float weight = along.x * along.y * along.z;
    float azimuth = 2.0 * pi * (floor(place) + step.z) / float(azimuths);
    Path of = path;
    of.start = corner + step.xy + 0.5;
    of.direction = vec2(cos(azimuth), sin(azimuth));
    of.height = path.scale * heightAt(of.start);
    Horizon entry = rulingOf(of);
    sum.delta += weight * stored(entry.delta, horizonRange);
    sum.distance += weight * stored(entry.distance, distanceRange);
  }
  return sum;
}

// Where the horizon point of one of the four texels about the pixel, in one of the two azimuths
// about the light's, lies along the path. `candidate` is 0 to 7.
float candidateDistance(Path path, LocalLight light, int candidate) {
  float azimuths = float(textureSize(distanceTable, 0).z);
  vec2 texel = floor(path.start - 0.5) + vec2(candidate & 1, candidate >> 1 & 1);
  int azimuth = int(light.azimuth / (2.0 * pi) * azimuths) + (candidate >> 2);
  float distance = tableEntry(distanceTable, distanceRange, ivec2(texel), azimuth);
  return dot(texel + 0.5 - path.start, light.direction) +
         distance * cos(2.0 * pi * float(azimuth) / azimuths - light.azimuth);
}

// The highest of the tables' eight horizon points, each moved to the path and along it to the
// highest place within a texel or two: nothing is interpolated but the height map.
float resampledSlope(Path path, LocalLight light) {
  float highest = seenSlope(path, startOf(path));
  for (int k = 0; k < 8; ++k) {
    float centre = candidateDistance(path, light, k);
    float best = -1e30;
    float step = 1.0;
    for (int probe = 0; probe < 7; ++probe) {
      float t = centre + (probe == 0 ? 0.0 : (probe & 1) == 0 ? -step : step);
      float seen = t > 1e-3 && t <= min(searchRadius, knownDistance(path.start, path.direction)) ? seenSlope(path, horizonOf(path, t)) : -1e30;
      if (probe > 0 && (probe & 1) == 0) step *= 0.5;
      if (seen > best) {
        best = seen;
        centre = probe == 0 ? centre : t;
      }
    }
    highest = max(highest, best);
  }
  return highest;
}

// The tables as they are read. Along a bent path the horizon point that they name lies in the
// direction of the chord to it: they are asked once for where it lies and again in that
// direction.
Horizon tablesAt(Path path, LocalLight light) {
  float azimuth = light.azimuth;
  if (path.bend != vec2(0.0)) {
    vec2 chord = path.direction + distanceAt(path.start, azimuth) * path.bend;
    azimuth = atan(chord.y, chord.x);
    if (azimuth < 0.0) azimuth += 2.0 * pi;
  }
  return Horizon(horizonAt(path.start, azimuth), distanceAt(path.start, azimuth));
}

// tan β′ by the switches that are on.
float ladderSlope(Path path, LocalLight light) {
  if (isOn(resampled)) {
    return isOn(ruling) ? seenSlope(path, rulingOf(path)) : resampledSlope(path, light);
  }
  return seenSlope(path, isOn(ruling) ? rulingAt(path, light) : tablesAt(path, light));
}

bool isShadowed(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, light);
  if (!isOn(along)) {
    path.bend = vec2(0.0);
    path.growth = 0.0;
  }
  if (!isOn(curved)) path.curvature = 0.0;
  if (!isOn(curved) || !isOn(along)) path.turn = 0.0;
  path.limit = pathLimit(path, pathEnd(path));
  if (isOn(resampled) && isOn(ruling) && isOn(angles) && isOn(denominator)) {
    return shadowedByBareSurface(path) || shadowedAtCrossings(path, path.limit);
  }

  path.height = pixel.worldPerHeight * heightAt(pixel.texel);
  float slope = ladderSlope(path, light);
  if (path.curvature > 0.0) slope = max(slope, bareHorizon(path.curvature, path.height));  // (3)
  return !(light.slope > slope);
}
