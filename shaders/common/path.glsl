// The path over the map that lies under the ray to the light, and the surface along it, from
// nothing but the interpolated frame and its screen derivatives.
//
// A straight line in the texture is not where the ray passes: on a sphere laid out by longitude and
// latitude great circles bend. To third order in its length the section of the surface with the
// light's plane is a geodesic. With t its arc length in texels of the pixel, e the light's
// direction there and P_ee = e_i e_j P_ij,
//   x(t) = x + t e + ½ t² b,   P_x b_x + P_y b_y = -(tangential part of P_ee),
// the geodesic equation at t = 0: b^k = -Γ^k_ij e_i e_j. In a triangle P_x and P_y are linear in
// (x, y), so that P_ee follows from the derivatives on the screen, whatever the view.
//
// The curvature changes along the way too: κ(s) = κ + κ′s lets the surface fall by κ s²/2 + κ′s³/6,
// as a circle of curvature κ + κ′s/3 does. And where heights are in texels, their unit a grows with
// |P_x × P_y|^½.

#ifdef TABLE_HEIGHT

struct Path {
  vec2 start;           // x, texels
  vec2 direction;       // e
  vec2 bend;            // b / 2
  float worldPerTexel;  // σ
  float curvature;      // κ, 1 / world
  float turn;           // κ′ σ / 3: change of the circle's curvature, 1 / world per texel
  float scale;          // a, world length per height unit
  float growth;         // change of a, per texel
  float height;         // h₀, world
  float rise;           // slope of the flat relief at r → 0⁺, world
  float slope;          // tan θ
  float border;         // where the surface ends, texels; 1e30 where it goes on
  float limit;          // no bump farther than this hides the light, texels
};

vec2 pathPoint(Path path, float t) { return path.start + t * (path.direction + t * path.bend); }

// sin γ / γ and (1 - cos γ) / γ.
float sineOver(float angle) {
  float q = angle * angle;
  return 1.0 + q * (-0.166183 + q * 0.00769);
}

float versineOver(float angle) {
  float q = angle * angle;
  return angle * (0.5 + q * (-0.0416083 + q * 0.00130917));
}

// By how much a bump of `bump` height units at t stands over the ray to the light: shadowed where
// that is 0 or more. With γ = κt the horizon of osculating.glsl, tan β′ ≥ tan θ, times sin γ (1 +
// κh₁) / κ > 0 and without the difference of numbers near 1:
//   h₁ (1 - κ D) - h₀ - D ≥ 0,   D = (1 - cos γ) / κ + tan θ sin γ / κ.
// Both quotients are polynomials, right to 2e-4 up to a quarter turn, so that κ → 0 needs no case.
float excess(Path path, float t, float bump) {
  float arcLength = t * path.worldPerTexel;
  float curvature = path.curvature + t * path.turn;
  float angle = curvature * arcLength;
  float sine = sineOver(angle);
  float versine = versineOver(angle);
  float drop = arcLength * (versine + path.slope * sine);
  float occluder = (path.scale + t * path.growth) * bump;
  return occluder * (1.0 - curvature * drop) - path.height - drop;
}

float excess(Path path, float t) { return excess(path, t, heightAt(pathPoint(path, t))); }

// The slope tan β′ at which a bump of `bump` height units at t is seen, where excess is 0:
//   tan β′ = (h₁ - h₀ - (1 - cos γ) / κ · p) / (sin γ / κ · p),   p = 1 + κh₁.
float slopeOf(Path path, float t, float bump) {
  float arcLength = t * path.worldPerTexel;
  float curvature = path.curvature + t * path.turn;
  float angle = curvature * arcLength;
  float occluder = (path.scale + t * path.growth) * bump;
  float peak = arcLength * max(1.0 + curvature * occluder, 1e-3);
  return (occluder - path.height - versineOver(angle) * peak) / (sineOver(angle) * peak);
}

// Where the ray has left the highest bump below it for good. Over a convex surface the ray climbs
// by at least (1 + κh₀) (tan θ s + κs²/2), where that is above 0. In a bowl the surface comes up
// again: there it climbs by tan θ s - |κ| (1 + 2 tan²θ) s²/2 at first, and is back after more than
// the chord sin θ s - |κ| s²/2 says.
float pathLimit(Path path, float farthest) {
  float highest = path.scale * heightBounds.y;
  float climb = path.slope - path.growth * heightBounds.y / path.worldPerTexel;
  float free = max(highest - path.height, 0.0) / max(1.0 + path.curvature * path.height, 0.1);
  float low = min(path.curvature, path.curvature + farthest * path.turn);
  float end = farthest * path.worldPerTexel;
  float chord = climb * inversesqrt(1.0 + climb * climb) * end + 0.5 * low * end * end;
  bool back = low < 0.0 && chord <= free;
  low *= low < 0.0 ? 1.0 + 2.0 * climb * climb : 1.0;
  float square = climb * climb + 2.0 * low * free;
  float root = climb + sqrt(max(square, 0.0));
  bool leaves = !back && square >= 0.0 && root > 0.0;
  return leaves ? min(farthest, 2.0 * free / (root * path.worldPerTexel)) : farthest;
}

// Where the path itself is no longer known: past the radius that is searched; past a border; past a
// quarter turn; and where the path has turned by half a radian, since its next term is not known.
float pathEnd(Path path) {
  float quarter = 0.5 * pi / path.worldPerTexel;
  float curvature = abs(path.curvature);
  float root = sqrt(curvature * curvature + 4.0 * quarter * abs(path.turn));
  float end = min(searchRadius, 2.0 * quarter / max(curvature + root, 1e-20));
  end = min(end, 0.25 / max(length(path.bend), 1e-20));
  return min(end, path.border);
}

// Calls derivatives: before any branch.
Path makePath(Pixel pixel, LocalLight light) {
  Path path;
  path.start = pixel.texel;
  path.direction = light.direction;
  path.worldPerTexel = light.worldPerTexel;
  path.curvature = normalCurvature(pixel, light.tangent);  // (1)
  path.scale = pixel.worldPerHeight;
  path.slope = light.slope;

  // The cell that lies ahead knows both h₀ and the slope at r → 0⁺.
  vec2 step = 1e-3 * light.direction;
  Cell cell = heightCell(pixel.texel + step);
  path.rise = path.scale * dot(gradientIn(cell), light.direction) / light.worldPerTexel;
  cell.fraction -= step;
  path.height = path.scale * heightIn(cell);

  // The way on the screen of one texel along e. A triangle seen from its edge tells nothing.
  vec2 texelX = dFdx(texel);
  vec2 texelY = dFdy(texel);
  float area = texelX.x * texelY.y - texelX.y * texelY.x;
  bool known = area * area > 1e-8 * dot(texelX, texelX) * dot(texelY, texelY);
  vec2 e = light.direction;
  vec2 way = vec2(e.x * texelY.y - e.y * texelY.x, texelX.x * e.y - texelX.y * e.x) /
             (known ? area : 1.0) * (known ? 1.0 : 0.0);

  vec3 changeX = dFdx(px) * way.x + dFdy(px) * way.y;
  vec3 changeY = dFdx(py) * way.x + dFdy(py) * way.y;
  vec3 change = e.x * changeX + e.y * changeY;  // P_ee
  vec3 across = cross(pixel.px, pixel.py);
  float volume = dot(across, pixel.normal);
  path.bend = -0.5 * vec2(dot(change, cross(pixel.py, pixel.normal)),
                          dot(change, cross(pixel.normal, pixel.px))) / volume;
  float grown = dot(cross(changeX, pixel.py) + cross(pixel.px, changeY), across);
  path.growth = heightInTexels ? 0.5 * path.scale * grown / dot(across, across) : 0.0;
  Pixel changing = pixel;
  changing.k1 = dFdx(curvatures.x) * way.x + dFdy(curvatures.x) * way.y;
  changing.k2 = dFdx(curvatures.y) * way.x + dFdy(curvatures.y) * way.y;
  path.turn = normalCurvature(changing, light.tangent) / 3.0;

  path.border = knownDistance(path.start, path.direction, path.bend);
  path.limit = pathLimit(path, pathEnd(path));
  return path;
}

// The slope of the bare surface's horizon, (3); -1e9 where it has none.
float bareSlope(Path path) {
  return path.curvature > 0.0 ? bareHorizon(path.curvature, path.height) : -1e9;
}

// Shadowed by the bare surface, (3).
bool shadowedByBareSurface(Path path) {
  return path.curvature > 0.0 && !(path.slope > bareHorizon(path.curvature, path.height));
}

// Shadowed by the slope that the point lies on, seen on the osculating circle: an attached shadow
// (d = 0) that is more exact than that of the bumped normal, and that no method is scored with.
bool shadowedByOwnSlope(Path path) {
  return !(path.slope > osculatingHorizon(path.curvature, path.height, path.rise, 0.0));
}

// A disc has one horizon in every azimuth; a march knows one, and the share that it gives is right
// where the horizon is straight across the disc. So each half of the disc, left and right, gets a
// march of its own, through the middle of its area, 4ρ / 3π beside the centre: a half's share over
// a level horizon is the whole's, so that V = ½ (V₁ + V₂), right to first order where the horizon
// is tilted. As far as the two are nowhere a fifth of a texel apart they are one, toward the
// centre.
const float halfCentre = 0.42441318;  // 4 / 3π

// How far that is, texels.
float parting() { return 0.2 / (2.0 * halfCentre * max(lightRadius, 1e-6)); }

// The direction to a half, 0 or 1: on the great circle through the disc's centre that is level there. On
// it tan θ falls off to both sides as the horizon of a wall across the light does.
vec3 halfDirection(Pixel pixel, LocalLight light, int side) {
  float size = max(dot(light.tangent, light.tangent), 1e-30);
  vec3 across = cross(pixel.normal, light.tangent) * inversesqrt(size);
  float off = (side == 0 ? halfCentre : -halfCentre) * lightRadius;
  return normalize(lightDirection + off * across);
}

LocalLight halfLight(Pixel pixel, LocalLight light, int side) {
  return makeLocalLight(pixel, halfDirection(pixel, light, side));
}

// The path to it, from the one to the centre.
Path pathToward(Path path, LocalLight light) {
  path.direction = light.direction;
  path.worldPerTexel = light.worldPerTexel;
  path.border = knownDistance(path.start, path.direction, path.bend);
  return path;
}

// Along the path the bilinear relief has its kinks, and nearly always its horizon, where it crosses
// the lines of texel centres.
struct Crossings {
  vec2 next;  // the next crossing of a column and of a row, texels along the path
  vec2 step;  // from one to the next
};

Crossings firstCrossings(Path path) {
  Crossings at;
  at.step = 1.0 / max(abs(path.direction), 1e-6);
  vec2 passed = fract(path.start - 0.5);
  at.next = mix(passed, 1.0 - passed, greaterThan(path.direction, vec2(0.0))) * at.step;
  at.next += mix(vec2(0.0), at.step, lessThan(at.next, vec2(1e-3)));  // where the path begins
  return at;
}

float nextCrossing(Crossings at) { return min(at.next.x, at.next.y); }

void pass(inout Crossings at) {
  if (at.next.x <= at.next.y) {
    at.next.x += at.step.x;
  } else {
    at.next.y += at.step.y;
  }
}

// The crossings from t on, t ≥ 0.
Crossings crossingsFrom(Path path, float t) {
  Crossings at = firstCrossings(path);
  at.next += at.step * max(ceil((t - at.next) / at.step), 0.0);
  return at;
}

// The relief at two crossings, the ends of a cell.
struct CellEnds {
  vec2 place;   // texels along the path
  vec2 height;  // h there, height units
};

// The cell from one crossing to the next.
CellEnds cellEnds(Path path, float enter, float leave, vec2 texelSize) {
  // Half of the way through the cell, and its place there.
  float far = 0.5 * (leave - enter);
  float middle = enter + far;
  vec2 bent = middle * path.bend;
  Cell cell = heightCell(path.start + middle * (path.direction + bent), texelSize);
  vec2 way = far * (path.direction + 2.0 * bent);
  // Both ends no farther than the cell goes, and a thousandth of a texel: a bent path does not
  // leave it where a straight one would.
  vec2 room = 1e-3 + mix(cell.fraction, 1.0 - cell.fraction, greaterThan(way, vec2(0.0)));
  vec2 each = 1.0 / max(abs(way), 1e-6);
  vec2 back = (1.002 - room) * each;
  vec2 on = room * each;
  float first = min(min(back.x, back.y), 1.0);
  float second = min(min(on.x, on.y), 1.0);
  CellEnds ends;
  ends.height = vec2(heightIn(cell.heights, cell.fraction - first * way),
                     heightIn(cell.heights, cell.fraction + second * way));
  ends.place = vec2(middle - first * far, middle + second * far);
  return ends;
}

// Whether the relief hides the light at a crossing up to `end`. The two ends of a cell are two
// crossings, so that every other cell of the way is enough, and with it half of the reads. The loop
// has one way out, since a software renderer pays for each in every step, and that at its top: of a
// loop left at its end alone Mesa 22's goes on to change the result of pixels that have left it.
bool shadowedAtCrossings(Path path, Crossings at, float end) {
  end = min(end, path.border);
  vec2 texelSize = 1.0 / vec2(textureSize(heightMap, 0));
  float most = -1.0;  // excess
  for (float enter = nextCrossing(at); enter <= end && most < 0.0; enter = nextCrossing(at)) {
    pass(at);
    float leave = nextCrossing(at);
    pass(at);
    CellEnds ends = cellEnds(path, enter, leave, texelSize);
    float before = excess(path, ends.place.x, ends.height.x);
    float after = excess(path, ends.place.y, ends.height.y);
    most = max(before, leave <= end ? after : -1.0);
  }
  // A surface that rises to its border hides most there, past the last line of texel centres.
  if (path.border <= end && most < 0.0) most = excess(path, end);
  return most >= 0.0;
}

// The same for a horizon: the larger of `lowest` and the slopes at which the relief is seen at the
// crossings up to `end`, as far as one that is `enough`; `at` is then past the last. What is nearer
// than a few thousandths of a texel has no slope in float.
float horizonAtCrossings(Path path, inout Crossings at, float end, float lowest, float enough) {
  end = min(end, path.border);
  vec2 texelSize = 1.0 / vec2(textureSize(heightMap, 0));
  float most = lowest;
  for (float enter = nextCrossing(at); enter <= end && most < enough; enter = nextCrossing(at)) {
    pass(at);
    float leave = nextCrossing(at);
    pass(at);
    CellEnds ends = cellEnds(path, enter, leave, texelSize);
    float before = slopeOf(path, max(ends.place.x, 4e-3), ends.height.x);
    float after = slopeOf(path, max(ends.place.y, 4e-3), ends.height.y);
    most = max(most, max(enter > 4e-3 ? before : -1e9, leave <= end && leave > 4e-3 ? after : -1e9));
  }
  if (path.border <= end && end > 4e-3) {
    most = max(most, slopeOf(path, end, heightAt(pathPoint(path, end))));
  }
  return most;
}

bool shadowedAtCrossings(Path path, float end) {
  return shadowedAtCrossings(path, firstCrossings(path), end);
}

// V of a disc by its highest horizon, `lowest` or what the relief up to `end` raises it to.
// @param path  to the disc's lowest ray
float shareAtCrossings(Pixel pixel, LocalLight light, Path path, float end, float lowest) {
  float enough = slopeTurned(light.slope, tan(lightRadius));
  float together = min(end, parting());
  Crossings at = firstCrossings(path);
  float horizon = horizonAtCrossings(path, at, together, lowest, enough);
  if (end <= together || horizon >= enough) return shareOver(light.slope, horizon);
  float sum = 0.0;
  for (int side = 0; side < 2; ++side) {
    LocalLight to = halfLight(pixel, light, side);
    Path way = pathToward(path, to);
    Crossings on = crossingsFrom(way, together);
    sum += shareOver(to.slope, horizonAtCrossings(way, on, end, horizon, enough));
  }
  return 0.5 * sum;
}

#endif
