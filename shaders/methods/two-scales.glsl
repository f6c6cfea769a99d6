/* gnomon-method
title = "Two scales: the relief marched nearby, the body's depth from the light"
citation = "this project"
family = "ours"
symbol = "triangle"
tables = ["height"]
passes = ["light-depth"]
subdivisions = 4
light_mesh = "displaced"
normal = "own"

[parameters.light_pieces]
default = 9
minimum = 1
maximum = 1024
about = "pieces of every face's side of the displaced mesh that the light sees"

[parameters.depth_side]
default = 2048
minimum = 16
maximum = 8192
about = "texels a side of the depth map, which holds the whole surface"

[parameters.bias]
default = 1
minimum = 0
maximum = 64
about = "how far places on the displaced mesh may be off, texels of the depth map, beside piece_bias"

[parameters.piece_bias]
default = 0.5
minimum = 0
maximum = 16
about = "the same, pieces of the displaced mesh; the depth map hides, and the march sees, what is nearer"

[parameters.edge]
default = 0.25
minimum = 0
maximum = 16
about = "how far from the outlines of its shadows the depth map asks the march, pieces; a texel at least"

[parameters.trust]
default = 0.03
minimum = 0
maximum = 1
about = "the march overrules the depth map where its path errs less than this part of what the map may be off"

[parameters.search_samples]
default = 24
minimum = 1
maximum = 1024
about = "soft light: texels of the depth map that are asked for what hides some of the light"

[parameters.filter_samples]
default = 16
minimum = 1
maximum = 1024
about = "soft light: texels of the depth map that the share is taken of"
*/

// A march over the height map knows the relief to the texel, but not where the texture's seams and
// the body's bends lead; a depth map knows the whole body, but no more of the relief than the
// displaced mesh has, and nothing nearer than its bias. Each answers where the other cannot:
//
//  - A sample of the depth map is off by up to u = bias × its texel + piece_bias × a piece of the
//    mesh. On a facet at the angle φ to the light its depth is off by u tan φ at most. Samples are
//    compared with the depths of the plane of the displaced facet, which leaves half of that, and u
//    itself for pieces whose facets have other slopes:  A = u (1 + ½ tan φ), tan φ ≤ 16.
//  - What is nearer than A along the ray is therefore lost to the depth map. Over t texels of the
//    path, σ long each, a ray at the slope tan θ gets t σ √(1 + tan² θ) far, so that the march must
//    go up to  t = A / (σ √(1 + tan² θ)). That is a few texels, whatever the body.
//  - Outlines of shadows of flat pieces, sampled at texels, run beside the true ones. Within `edge`
//    pieces of them, or a texel, the map sees something nearer at some texels only, by D at most. The
//    march then goes on as far as that is, or as its path is nearer to the true one than u
//    (marchEnd): what it meets hides the light. And light that it finds overrules the map where it
//    knows the way much better (isPathKnown).
//
// The camera draws the base mesh. It lies below the surface where that is convex: see surfacePoint.

const float steepest = 16.0;  // tan φ

// n_x along a tangent vector of P_x's kind (Weingarten: the normal turns with the curvature).
vec3 turnOfNormal(Pixel pixel, vec3 along) {
  float first = dot(along, pixel.v1) / max(dot(pixel.v1, pixel.v1), 1e-30);
  float second = dot(along, pixel.v2) / max(dot(pixel.v2, pixel.v2), 1e-30);
  return pixel.k1 * first * pixel.v1 + pixel.k2 * second * pixel.v2;
}

// The normal of D = P + a h n with all its terms: D_x = P_x + a h_x n + a h n_x. Bump mapping leaves
// out the last, which counts where the relief is as high as the body is thick.
vec3 shadingNormal(Pixel pixel) {
  Cell cell = heightCell(pixel.texel);
  float height = pixel.worldPerHeight * heightIn(cell);
  vec2 rise = pixel.worldPerHeight * gradientIn(cell);
  vec3 alongX = pixel.px + rise.x * pixel.normal + height * turnOfNormal(pixel, pixel.px);
  vec3 alongY = pixel.py + rise.y * pixel.normal + height * turnOfNormal(pixel, pixel.py);
  vec3 facet = normalize(cross(alongX, alongY));
  return dot(facet, pixel.normal) < 0.0 ? -facet : facet;
}

// P from the drawn triangle. Where corners p_i with normals n_i have the weights w_i, the surface
// stands ½ Σ w_i κ |p_i - p|² above, and the interpolated normal is shorter than 1 by
// ½ Σ w_i |n_i - n|² = ½ Σ w_i κ² |p_i - p|². With corners spread alike along both principal
// directions the quotient is (κ₁ + κ₂) / (κ₁² + κ₂²); on a sphere 1 / κ, exactly of second order.
vec3 surfacePoint(Pixel pixel) {
  float rounding = 4e-7;
  float shorter = max(1.0 - length(normal) - rounding, 0.0);
  float squares = pixel.k1 * pixel.k1 + pixel.k2 * pixel.k2;
  float above = squares > 0.0 ? shorter * (pixel.k1 + pixel.k2) / squares : 0.0;
  return pixel.position + above * pixel.normal;
}

// World length of a piece's side: of the square with the piece's diagonals, √(½ (|P_s|² + |P_t|²)) over
// the pieces a side, since a long piece is as far off as it is long. Both (s, t) and the position are
// even over a triangle, so that P_s and P_t follow from the derivatives in every view. Calls
// derivatives.
float pieceLength() {
  vec2 stX = dFdx(st);
  vec2 stY = dFdy(st);
  vec3 alongX = dFdx(position);
  vec3 alongY = dFdy(position);
  vec3 alongS = stY.y * alongX - stX.y * alongY;
  vec3 alongT = stX.x * alongY - stY.x * alongX;
  float area = max(abs(stX.x * stY.y - stX.y * stY.x), 1e-20);
  return sqrt(0.5 * (dot(alongS, alongS) + dot(alongT, alongT))) / (area * light_pieces);
}

// Whether a texel of the depth map is nearer to the light than the plane through place.z.
bool isNearer(vec3 place, vec2 tilt, vec2 texel) {
  return lightDepthOf(ivec2(texel)) < place.z + dot(tilt, texel + 0.5 - place.xy);
}

// Share of such texels about a place, with bilinear weights (percentage-closer filtering): its half is
// a smooth outline, finer than the texels.
float shareNearer(vec3 place, vec2 tilt) {
  vec2 corner = floor(place.xy - 0.5);
  vec2 fraction = place.xy - 0.5 - corner;
  float share = 0.0;
  for (int k = 0; k < 4; ++k) {
    vec2 step = vec2(k & 1, k >> 1);
    vec2 weight = mix(1.0 - fraction, fraction, step);
    share += isNearer(place, tilt, corner + step) ? weight.x * weight.y : 0.0;
  }
  return share;
}

// What the depth map sees about a place: at five texels, its own and those at the corners of a square.
struct Blockers {
  int count;   // of those that are nearer to the light than the place
  float most;  // the largest D of these, in depth
  float own;   // D of the place's own texel; 0 where it is not nearer
};

// @param far  half the square's side, texels
Blockers blockersAbout(vec3 place, vec2 tilt, float far) {
  Blockers seen = Blockers(0, 0.0, 0.0);
  for (int k = 0; k < 5; ++k) {
    vec2 corner = k < 4 ? vec2(k & 1, k >> 1) * 2.0 - 1.0 : vec2(0.0);
    vec2 texel = floor(place.xy + far * corner);
    bool isBlocker = isNearer(place, tilt, texel);
    seen.own = isBlocker ? max(place.z - lightDepthOf(ivec2(texel)), 0.0) : 0.0;
    seen.most = max(seen.most, seen.own);
    seen.count += isBlocker ? 1 : 0;
  }
  return seen;
}

// `edge` pieces in texels of the map, and one at least, since that is how far apart its samples are.
float outlineReach(float piece) { return max(edge * piece / lightMapLengths.x, 1.0); }

// Where the depth map is asked for a pixel.
struct DepthPlace {
  vec3 place;            // in the map, A nearer to the light than the displaced point
  vec2 tilt;             // of the plane of its facet
  float off;             // u, world
  float near;            // t, what of the path is lost to the map, texels
  float texelsPerDepth;  // of the path, for a depth of 1
};

// @param cosine  of the facet to the light's centre
DepthPlace depthPlaceOf(Pixel pixel, LocalLight light, Path path, float piece, vec3 facet,
                        float cosine) {
  float slope = min(sqrt(max(1.0 - cosine * cosine, 0.0)) / max(cosine, 1e-6), steepest);
  float texelsPerWorld = 1.0 / (path.worldPerTexel * sqrt(1.0 + light.slope * light.slope));
  DepthPlace at;
  at.off = bias * lightMapLengths.x + piece_bias * piece;
  float allowance = at.off * (1.0 + 0.5 * slope);
  at.near = allowance * texelsPerWorld;
  at.texelsPerDepth = lightMapLengths.y * texelsPerWorld;
  at.place = lightMapPlace(surfacePoint(pixel) + path.height * pixel.normal);
  at.place.z -= allowance / lightMapLengths.y;
  at.tilt = lightMapTilt(facet, max(cosine, 1.0 / steepest));
  return at;
}

// By how much the march errs sideways for each world length of its path, |τ| H at the highest relief
// H: the surface's normal turns about the path by its geodesic torsion τ, and the path's columns of
// relief lean with it.
float leanOf(Pixel pixel, LocalLight light, Path path) {
  float square = max(dot(light.tangent, light.tangent), 1e-30);
  vec3 side = cross(pixel.normal, light.tangent);
  float torsion = dot(turnOfNormal(pixel, light.tangent), side) / square;
  return abs(torsion) * max(path.height, path.scale * heightBounds.y);
}

// Where the march ends, texels: `past` what is lost to the map, but there only as far as its columns
// lean less than the map may be off.
float marchEnd(DepthPlace at, Path path, float past, float lean) {
  float known = at.off / max(lean * path.worldPerTexel, 1e-30);
  return min(min(at.near + past, max(at.near, known)), path.limit);
}

// Whether the march knows its path as far as t, texels, better than the depth map knows the mesh. After
// the arc length s the path errs by the lean, and in height by ½ κ² s³, the order of the first term
// that a changing circle leaves out. And both see the same: at the map's blocker the relief ends
// within 2u of the ray.
bool isPathKnown(Path path, float t, float off, float lean) {
  float s = t * path.worldPerTexel;
  float angle = path.curvature * s;
  float error = 0.5 * angle * angle * s + lean * s;
  return t < path.limit && error < trust * off && abs(excess(path, t)) < 2.0 * off;
}

bool isShadowed(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, light);
  float piece = pieceLength();
  vec3 facet = shadingNormal(pixel);
  float cosine = dot(facet, lightDirection);
  if (!(cosine > 0.0)) return true;

  DepthPlace at = depthPlaceOf(pixel, light, path, piece, facet, cosine);
  Blockers seen = blockersAbout(at.place, at.tilt, outlineReach(piece));
  if (seen.count == 5) return true;
  // Blockers are off by as much as is lost to the map: past the farthest of them.
  float past = seen.most > 0.0 ? seen.most * at.texelsPerDepth + at.near : 0.0;
  float lean = leanOf(pixel, light, path);
  if (shadowedAtCrossings(path, marchEnd(at, path, past, lean))) return true;
  bool isLit = isPathKnown(path, seen.own * at.texelsPerDepth, at.off, lean);
  return !isLit && shareNearer(at.place, at.tilt) > 0.5;
}

// A disc as light. What stands D nearer to the light hides some of it where it lies within D tan ρ
// of the place, across the light. So the texels that are asked lie on a spiral, denser inward,
// where small D count too: the k-th of n at (k/n)² of the reach of all that the map can hold. Each
// counts where it lies within its own reach, and their mean D gives the radius of the penumbra, D
// tan ρ. The share of that disc which is not nearer is V (percentage-closer soft shadows, Fernando
// 2005, but for the reach). A disc smaller than a texel has no texels to count: there the bilinear
// share tells how far the outline is, share - ½ texels, and the closed form for a straight edge
// gives V.
//
// The march goes on as far as the farthest of all that hides some of the light. It keeps its highest
// horizon, twice where the disc is wide (marchesUpTo). Where it knows the path to what hides the light,
// its share is the answer. Elsewhere what either hides is at the lower side of the disc, mostly the
// same: the smaller share is.

// What hides some of the light: its mean D and its largest, in depth; 0 where nothing does.
vec2 blockerDistances(vec3 place, vec2 tilt, float reach) {
  int count = int(search_samples);
  vec2 sum = vec2(0.0);  // number, D
  float most = 0.0;
  vec2 toward = vec2(1.0, 0.0);
  for (int k = 0; k < count; ++k) {
    float share = (float(k) + 0.5) / float(count);
    vec2 offset = reach * place.z * share * share * toward;
    toward = goldenTurn(toward);
    vec2 texel = floor(place.xy + offset);
    float nearer = place.z - lightDepthOf(ivec2(texel));
    bool isBlocker = isNearer(place, tilt, texel) && length(offset) <= reach * nearer + 1.0;
    sum += isBlocker ? vec2(1.0, nearer) : vec2(0.0);
    most = max(most, isBlocker ? nearer : 0.0);
  }
  return max(vec2(sum.y / max(sum.x, 1.0), most), 0.0);
}

// V by the depth map, with the penumbra's radius in its texels.
float shareByDepth(vec3 place, vec2 tilt, float radius) {
  float outline = 0.5 - shareNearer(place, tilt);
  if (radius <= 1.0) return discShare(outline / max(radius, 1e-3));
  int count = int(filter_samples);
  float nearer = 0.0;
  vec2 toward = vec2(radius, 0.0);
  for (int k = 0; k < count; ++k) {
    vec2 texel = floor(place.xy + sqrt((float(k) + 0.5) / float(count)) * toward);
    toward = goldenTurn(toward);
    nearer += isNearer(place, tilt, texel) ? 1.0 : 0.0;
  }
  return 1.0 - nearer / float(count);
}

float visibility(Pixel pixel, LocalLight light) {
  Path path = makePath(pixel, lowestRay(light));
  float piece = pieceLength();
  vec3 facet = shadingNormal(pixel);
  float cosine = dot(facet, lightDirection);
  if (!(cosine > -sin(lightRadius))) return 0.0;

  DepthPlace at = depthPlaceOf(pixel, light, path, piece, facet, cosine);
  float reach = tan(lightRadius) * lightMapLengths.y / lightMapLengths.x;  // texels, of depth 1
  vec2 distances = blockerDistances(at.place, at.tilt, reach);
  float far = shareByDepth(at.place, at.tilt, reach * distances.x);
  Blockers seen = blockersAbout(at.place, at.tilt, outlineReach(piece));
  if (far <= 0.0 && seen.count == 5) return 0.0;
  float enough = slopeTurned(light.slope, tan(lightRadius));
  float lean = leanOf(pixel, light, path);
  float past = max(distances.y, seen.most) * at.texelsPerDepth;
  float end = marchEnd(at, path, past, lean);
  int marches = marchesUpTo(end);
  float sum = 0.0;
  for (int march = 0; march < marches; ++march) {
    LocalLight to = marchedLight(pixel, light, march, marches);
    Path way = marchedPath(path, to);
    Crossings passed = firstCrossings(way);
    sum += shareOver(to.slope, horizonAtCrossings(way, passed, end, bareSlope(path), enough));
  }
  float share = sum / float(marches);
  float blocker = distances.x > 0.0 ? distances.x : seen.own;
  bool isKnown = isPathKnown(path, blocker * at.texelsPerDepth, at.off, lean);
  return isKnown ? share : min(far, share);
}
