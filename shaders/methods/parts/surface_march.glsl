/* gnomon-part
tables = ["height"]

[[pass]]
name = "column"
kind = "texture"
channels = 3
about = "a n, world: what a height unit adds to P"

[parameters.leg]
default = 2
minimum = 0.25
maximum = 16
about = "longest part of the way between two of its places that are solved for, texels"
*/

// The march over maps of the surface.
//
// The relief's points are D = P + h a n. A march must know over which place (x, y) of the map the ray
// is, and how high, η height units. The other marches predict both from the pixel's frame and its
// changes, and err the more the farther they go. Maps of P and a n tell: after a world length s along
// the ray r from the displaced point O
//
//   P(x, y) + η a n(x, y) = O + s r.
//
// The march goes in legs. From a solved place the ray's velocity over the map, (ẋ, ẏ, η̇) with
// ẋ D_x + ẏ D_y + η̇ a n = r at h = η, and the last leg's bend lead to a guess `leg` texels on, and one
// step of Newton's method from there to the place itself. In between place and height follow the
// parabola with that velocity through both ends. The relief is looked at where this path crosses the
// lines of texel centres, as in geodesic-march: what is H high is seen at O + s r + (H - η) a n.
//
// The march ends over the highest bump, where the ray rises and the surface does not bend up to it;
// at the end of the map or of the search; at the border of a chart, and where another chart has the
// texels; and in a fold so narrow that columns of relief meet.

vec3 passColumn(Pixel pixel) { return pixel.worldPerHeight * columnAxis(pixel); }

// The surface at a place of the map, with its changes per texel.
struct Surface {
  vec3 point, pointX, pointY;     // P, world
  vec3 column, columnX, columnY;  // a n, world
  bool isKnown;                   // whether all four texels about the place are its chart's
};

// Bilinear between four texels, and straight on past the end of a map that does not close. Between
// texels the surface stands over the bilinear one, along the normal: for x by ½ f (1 - f) (-P_xx · n),
// where -P_xx · n = P_x · n_x, since P_x · n = 0 everywhere; for y likewise. And the bilinear normal is
// too short, by ½ f (1 - f) n_x · n_x.
Surface surfaceAt(vec2 at) {
  ivec2 size = textureSize(pointPass, 0);
  bvec2 closes = closingAxes(size);
  vec2 corner = floor(at - 0.5) - vec2(pointOrigin);
  corner = mix(clamp(corner, vec2(0.0), vec2(size - 2)), corner, closes);
  vec2 f = at - 0.5 - vec2(pointOrigin) - corner;
  ivec2 low = mix(ivec2(corner), wrapped(ivec2(corner), size), closes);
  ivec2 high = mix(ivec2(corner) + 1, wrapped(ivec2(corner) + 1, size), closes);
  vec4 p00 = passTexel(pointPass, low, 0);
  vec4 p10 = passTexel(pointPass, ivec2(high.x, low.y), 0);
  vec4 p01 = passTexel(pointPass, ivec2(low.x, high.y), 0);
  vec4 p11 = passTexel(pointPass, high, 0);
  vec3 c00 = passTexel(columnPass, low, 0).xyz;
  vec3 c10 = passTexel(columnPass, ivec2(high.x, low.y), 0).xyz;
  vec3 c01 = passTexel(columnPass, ivec2(low.x, high.y), 0).xyz;
  vec3 c11 = passTexel(columnPass, high, 0).xyz;

  Surface there;
  // The last channel of a pass over the texture is a texel's mark. A border is half a texel beyond the
  // outermost centres, and a bent path may miss it by a little.
  there.isKnown = min(min(p00.w, p10.w), min(p01.w, p11.w)) > 0.0 &&
                  all(lessThan(abs(f - 0.5), vec2(1.5)));
  if (chartsOverlap) {
    bvec4 others = bvec4(isOfOtherChart(p00.w), isOfOtherChart(p10.w), isOfOtherChart(p01.w),
                         isOfOtherChart(p11.w));
    there.isKnown = there.isKnown && !any(others);
  }
  there.column = mix(mix(c00, c10, f.x), mix(c01, c11, f.x), f.y);
  there.columnX = mix(c10 - c00, c11 - c01, f.y);
  there.columnY = mix(c01 - c00, c11 - c10, f.x);
  there.point = mix(mix(p00.xyz, p10.xyz, f.x), mix(p01.xyz, p11.xyz, f.x), f.y);
  there.pointX = mix(p10.xyz - p00.xyz, p11.xyz - p01.xyz, f.y);
  there.pointY = mix(p01.xyz - p00.xyz, p11.xyz - p10.xyz, f.x);
  vec3 c = there.column;
  float square = max(dot(c, c), 1e-30);
#ifdef ON_POLYGONS
  vec2 rise = vec2(0.0);  // flat between texels
#else
  vec2 rise = 0.5 * vec2(dot(there.pointX, there.columnX), dot(there.pointY, there.columnY)) / square;
#endif
  vec2 growth = vec2(dot(there.columnX, c), dot(there.columnY, c)) / square;  // of a, relative
  vec2 changeSquared = vec2(dot(there.columnX, there.columnX), dot(there.columnY, there.columnY)) / square;
  vec2 turn = 0.5 * (changeSquared - growth * growth);
  vec2 middle = f * (1.0 - f);
  vec2 change = 1.0 - 2.0 * f;
  there.point += dot(rise, middle) * c;
  there.pointX += rise.x * change.x * c;
  there.pointY += rise.y * change.y * c;
  there.column += dot(turn, middle) * c;
  there.columnX += turn.x * change.x * c;
  there.columnY += turn.y * change.y * c;
  return there;
}

// Whether a place's changes per texel are about those of a place nearby: between the two ends of a map
// that only seems to close lies the whole surface.
bool goesOn(Surface there, vec3 nearbyX, vec3 nearbyY) {
  return distance(there.pointX, nearbyX) + distance(there.pointY, nearbyY) <
         length(nearbyX) + length(nearbyY);
}

// The surface at a pixel: by the maps, so that the march begins where they are, or by the pixel's own
// frame at a chart's border, where another chart has the texels, and where a map that seems to close
// does not.
Surface surfaceOf(Pixel pixel) {
  Surface there = surfaceAt(pixel.texel);
  if (there.isKnown && goesOn(there, pixel.px, pixel.py)) return there;
  there.point = surfacePoint(pixel);
  there.pointX = pixel.px;
  there.pointY = pixel.py;
  there.column = pixel.worldPerHeight * columnAxis(pixel);
  there.columnX = pixel.worldPerHeight * turnOfNormal(pixel, pixel.px);
  there.columnY = pixel.worldPerHeight * turnOfNormal(pixel, pixel.py);
  return there;
}

// The normal of D with all its terms: D_x = P_x + a h_x n + h (a n_x + a_x n), a_x from the maps.
vec3 shadingNormal(Pixel pixel) {
  Cell cell = heightCell(pixel.texel);
#ifdef ON_POLYGONS
  return displacedNormal(pixel, pixel.worldPerHeight * gradientIn(cell),
                         pixel.worldPerHeight * heightIn(cell));
#else
  Surface there = surfaceOf(pixel);
  float height = heightIn(cell);
  vec2 rise = pixel.worldPerHeight * gradientIn(cell);
  vec3 n = pixel.normal;
  rise += height * vec2(dot(there.columnX, n), dot(there.columnY, n));
  height *= pixel.worldPerHeight;
  vec3 facet = normalize(cross(displacedSide(pixel, pixel.px, rise.x, height),
                               displacedSide(pixel, pixel.py, rise.y, height)));
  return dot(facet, n) < 0.0 ? -facet : facet;
#endif
}

// (x, y, η) of a world vector at a height over the surface: texels and height units.
vec3 inMap(Surface there, float height, vec3 world) {
  vec3 alongX = there.pointX + height * there.columnX;
  vec3 alongY = there.pointY + height * there.columnY;
  vec3 across = cross(alongY, there.column);
  return vec3(dot(world, across), dot(world, cross(there.column, alongX)),
              dot(world, cross(alongX, alongY))) /
         dot(alongX, across);
}

// World volume of a texel times a height unit, at a height.
float volumeAt(Surface there, float height) {
  return dot(there.pointX + height * there.columnX,
             cross(there.pointY + height * there.columnY, there.column));
}

// Whether the highest columns stay apart. In a fold that is narrower than the relief is high they meet,
// and a world point has more than one place.
bool isUnfolded(Surface there) {
  float bare = volumeAt(there, 0.0);
  return bare * volumeAt(there, heightBounds.y) > 0.4 * bare * bare;
}

// A ray from the displaced point of a pixel, in the frame of its column: of a limit surface, its tangent
// plane. Polygons' columns lean, and what lies a little below a ray must not be seen behind its origin.
struct Ray {
  vec3 origin;  // O, world
  vec3 along;   // unit vectors at right angles to the column, below the ray
  vec3 up;      // and along the column
  vec3 toward;  // r, unit
};

// The ray to a light, lowered by an angle; the light's own slope is `slope`.
Ray rayToward(Pixel pixel, Surface there, float height, vec3 light, float lowered,
              out float slope) {
  Ray ray;
  ray.origin = there.point + height * there.column;
  ray.up = columnAxis(pixel);
  float sine = dot(light, ray.up);
  vec3 tangent = light - sine * ray.up;
  float cosine = length(tangent);
  // To a light overhead any direction does.
  ray.along = cosine > 1e-6 ? tangent / cosine : normalize(cross(pixel.py, ray.up));
  ray.toward = (cosine * cos(lowered) + sine * sin(lowered)) * ray.along +
               (sine * cos(lowered) - cosine * sin(lowered)) * ray.up;
  slope = sine / max(cosine, 1e-6);
  return ray;
}

// The path of a leg over the map: what path.glsl needs to find where it crosses lines of texels.
Path legPath(vec2 start, vec2 direction, vec2 bend) {
  Path path;
  path.start = start;
  path.direction = direction;
  path.bend = bend;
  return path;
}

// A leg of the march: from a solved place on, by texels along the path.
struct Leg {
  vec3 start;            // x, y and η
  vec3 velocity;         // their change per texel
  vec3 bend;             // and half the change of that
  float known;           // how far along the ray it starts, world
  float texelsPerWorld;  // of the ray
  float far;             // its length, texels
  vec3 column, columnAtEnd;
};

// The slope at which the ray sees what is `height` height units high at a place of a leg.
float slopeSeen(Ray ray, Leg leg, float place, float height) {
  float over = height - (leg.start.z + place * (leg.velocity.z + place * leg.bend.z));
  vec3 seen = (leg.known + place / leg.texelsPerWorld) * ray.toward +
              over * mix(leg.column, leg.columnAtEnd, place / leg.far);
  return dot(seen, ray.up) / max(dot(seen, ray.along), 1e-30);
}

// A march under way.
struct March {
  vec3 at;        // x, y and η of the last place that was solved for
  vec3 bend;      // half the change of the velocity, per texel
  Surface there;
  float known;    // how far along the ray the relief was seen, world
  float rest;     // how far it has still to go, texels; 0 where it has seen all that the ray could meet
  float horizon;  // the highest slope at which the relief is seen; -1e9 where there is none
  bool isWhole;   // whether the maps tell all the relief that the ray could meet
};

// The march from a pixel, before its first leg.
March marchFrom(Pixel pixel, Surface there, float height, Ray ray) {
  bool isConvex = normalCurvature(pixel, ray.along) >= 0.0;
  vec3 bend = vec3(0.0, 0.0, isConvex ? 0.0 : -1e-20);
  return March(vec3(pixel.texel, height), bend, there, 0.0, searchRadius, -1e9, true);
}

// Goes on along a ray until `rest` texels are left, or up to a horizon that is `enough`.
void marchAlong(inout March march, Ray ray, float rest, float enough) {
  vec2 texelSize = 1.0 / mapSize;
  // More legs than any map is wide, for the case of numbers that are none.
  for (int k = 0; k < 16384 && march.horizon < enough && march.rest > rest; ++k) {
    vec3 at = march.at;
    vec3 velocity = inMap(march.there, at.z, ray.toward);
    float texelsPerWorld = max(length(velocity.xy), 1e-30);
    velocity /= texelsPerWorld;
    march.isWhole = isUnfolded(march.there) && dot(velocity, velocity) < 1e20;
    bool isOver = at.z > heightBounds.y;
    bool isAway = isOver && velocity.z > 0.0 && march.bend.z >= 0.0;
    if (!march.isWhole || isAway) {
      march.rest = 0.0;
      break;
    }
    // Over all bumps a leg may be longer; of one that leaves them the rest need not be looked at.
    float border = knownDistance(at.xy, velocity.xy, march.bend.xy);
    float longest = min(march.rest, border);
    float far = min(isOver ? 4.0 * leg : leg, longest);
    if (!isOver && velocity.z > 0.0) far = min(far, max((heightBounds.y - at.z) / velocity.z, 0.5));

    float end = march.known + far / texelsPerWorld;
    vec3 to = at + far * (velocity + far * march.bend);
    Surface next = surfaceAt(to.xy);
    vec3 off = inMap(next, to.z, ray.origin + end * ray.toward - next.point - to.z * next.column);
    // A guess misses by less than a texel, unless the map does not go on as the surface does.
    march.isWhole = next.isKnown && dot(off.xy, off.xy) < 1.0 &&
                    goesOn(next, march.there.pointX, march.there.pointY);
    if (!march.isWhole) {
      march.rest = 0.0;
      break;
    }
    to += off;
    march.bend = (to - at - far * velocity) / (far * far);

    Leg way = Leg(at, velocity, march.bend, march.known, texelsPerWorld, far, march.there.column,
                  next.column);
    Path path = legPath(at.xy, velocity.xy, march.bend.xy);
    Crossings crossings = firstCrossings(path);
    // A crossing between two legs belongs to one of them, however it is rounded.
    float first = march.known > 0.0 ? 0.0 : 4e-3;  // nearer the relief has no slope in float
    float last = isOver && to.z > heightBounds.y ? 0.0 : far + 2e-3;
    for (float enter = nextCrossing(crossings); enter <= last && march.horizon < enough;
         enter = nextCrossing(crossings)) {
      pass(crossings);
      float leave = nextCrossing(crossings);
      pass(crossings);
      CellEnds ends = cellEnds(path, enter, leave, texelSize);
      for (int side = 0; side < 2; ++side) {
        float crossing = side == 0 ? enter : leave;
        float slope = slopeSeen(ray, way, ends.place[side], ends.height[side]);
        bool counts = crossing <= last && crossing > first;
        march.horizon = counts ? max(march.horizon, slope) : march.horizon;
      }
    }
    // A surface that rises to its border hides most there, past the last line of texel centres.
    if (far >= border && far > first) {
      march.horizon = max(march.horizon, slopeSeen(ray, way, far, heightAt(to.xy)));
    }
    march.known = end;
    march.rest = far < longest ? march.rest - far : 0.0;
    march.at = to;
    march.there = next;
  }
}

const float noRest = 1e-3;  // texels

// Toward a point of light; and its slope.
March marchToward(Pixel pixel, vec3 light, out float slope) {
  Surface there = surfaceOf(pixel);
  float height = heightAt(pixel.texel);
  Ray ray = rayToward(pixel, there, height, light, 0.0, slope);
  March march = marchFrom(pixel, there, height, ray);
  marchAlong(march, ray, noRest, slope);
  return march;
}

// V of a disc: the march follows its lowest ray as far as what hides all of it, from where its halves
// part one for each, as shareAtCrossings does.
// @param march  the last of them, whole if all are
float shareMarched(Pixel pixel, LocalLight light, out March march) {
  Surface there = surfaceOf(pixel);
  float height = heightAt(pixel.texel);
  float slope;
  Ray ray = rayToward(pixel, there, height, lightDirection, lightRadius, slope);
  float enough = slopeTurned(slope, tan(lightRadius));
  march = marchFrom(pixel, there, height, ray);
  marchAlong(march, ray, max(searchRadius - parting(), noRest), enough);
  if (march.rest <= noRest || march.horizon >= enough) return shareOver(slope, march.horizon);

  March together = march;
  bool isWhole = true;
  float sum = 0.0;
  for (int side = 0; side < 2; ++side) {
    march = together;
    vec3 toward = halfDirection(pixel, light, side);
    Ray own = rayToward(pixel, there, height, toward, lightRadius, slope);
    vec3 beside = march.known * (own.toward - ray.toward);
    march.at += inMap(march.there, march.at.z, beside);
    marchAlong(march, own, noRest, enough);
    isWhole = isWhole && march.isWhole;
    sum += shareOver(slope, march.horizon);
  }
  march.isWhole = isWhole;
  return 0.5 * sum;
}
