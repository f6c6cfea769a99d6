/* gnomon-part
tables = ["height"]

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

const float steepest = 16.0;  // tan φ

// What the depth map sees about a place: at five texels, its own and those at the corners of a square.
struct Blockers {
  int count;   // of those that are nearer to the light than the place
  float most;  // the largest D of these, in depth
  float own;   // D of the place's own texel; 0 where it is not nearer
};

// @param far  half the square's side, texels
Blockers blockersAbout(DepthPlace at, float far) {
  Blockers seen = Blockers(0, 0.0, 0.0);
  for (int k = 0; k < 5; ++k) {
    vec2 corner = k < 4 ? vec2(k & 1, k >> 1) * 2.0 - 1.0 : vec2(0.0);
    vec2 texel = floor(at.place.xy + far * corner);
    bool isBlocker = isNearer(at, texel);
    seen.own = isBlocker ? max(at.place.z - lightDepthOf(ivec2(texel)), 0.0) : 0.0;
    seen.most = max(seen.most, seen.own);
    seen.count += isBlocker ? 1 : 0;
  }
  return seen;
}

// `edge` pieces in texels of the map, and one at least, since that is how far apart its samples are.
float outlineReach(float piece) { return max(edge * piece / lightMapLengths.x, 1.0); }

// @param cosine  of the facet to the light's centre
DepthPlace depthPlaceOf(Pixel pixel, LocalLight light, Path path, float piece, vec3 facet,
                        float cosine) {
  float slope = min(sqrt(max(1.0 - cosine * cosine, 0.0)) / max(cosine, 1e-6), steepest);
  float texelsPerWorld = 1.0 / (path.worldPerTexel * sqrt(1.0 + light.slope * light.slope));
  DepthPlace at;
  at.off = bias * lightMapLengths.x + piece_bias * piece;
  at.allowance = at.off * (1.0 + 0.5 * slope);
  at.less = piece_bias * piece * (1.0 + 0.5 * slope) / lightMapLengths.y;
  at.near = at.allowance * texelsPerWorld;
  at.texelsPerDepth = lightMapLengths.y * texelsPerWorld;
  at.place = lightMapPlace(surfacePoint(pixel) + path.height * columnAxis(pixel));
  at.place.z -= at.allowance / lightMapLengths.y;
  at.tilt = lightMapTilt(facet, max(cosine, 1.0 / steepest));
  at.texelsPerWorld = 1.0 / path.worldPerTexel;
  at.start = path.start;
  at.toward = path.direction;
  at.end = path.start;
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

// Whether a point is hidden.
// @param path    to the light
// @param piece   pieceLength()
// @param facet   the normal of D, and `cosine` of it to the light's centre: above 0
bool isHiddenAtTwoScales(Pixel pixel, LocalLight light, Path path, float piece, vec3 facet,
                         float cosine) {
  DepthPlace at = depthPlaceOf(pixel, light, path, piece, facet, cosine);
  Blockers seen = blockersAbout(at, outlineReach(piece));
  if (seen.count == 5) return true;
  // Blockers are off by as much as is lost to the map: past the farthest of them.
  float past = seen.most > 0.0 ? seen.most * at.texelsPerDepth + at.near : 0.0;
  float lean = leanOf(pixel, light, path);
  float end = endOnChart(pixel, path, marchEnd(at, path, past, lean));
  if (shadowedAtCrossings(path, end)) return true;
  if (!(shareNearer(at) > 0.5)) return false;
  at.end = pathPoint(path, end);
  return isNearer(at, floor(at.place.xy)) || !isPathKnown(path, seen.own * at.texelsPerDepth, at.off, lean);
}

// The march goes on as far as the farthest of all that hides some of the light. Where it knows the path
// to what hides the light, its share is the answer. Elsewhere what either hides is at the lower side of
// the disc, mostly the same: the smaller share is.
// @param path  to the disc's lowest ray
float shareAtTwoScales(Pixel pixel, LocalLight light, Path path, float piece, vec3 facet,
                       float cosine) {
  DepthPlace at = depthPlaceOf(pixel, light, path, piece, facet, cosine);
  float reach = tan(lightRadius) * lightMapLengths.y / lightMapLengths.x;  // texels, of depth 1
  vec2 distances = blockerDistances(at, reach);
  float far = shareByDepth(at, reach * distances.x);
  Blockers seen = blockersAbout(at, outlineReach(piece));
  if (far <= 0.0 && seen.count == 5) return 0.0;
  float lean = leanOf(pixel, light, path);
  float past = max(distances.y, seen.most) * at.texelsPerDepth;
  float end = endOnChart(pixel, path, marchEnd(at, path, past, lean));
  float share = shareAtCrossings(pixel, light, path, end, bareSlope(path));
  float blocker = distances.x > 0.0 ? distances.x : seen.own;
  bool isKnown = isPathKnown(path, blocker * at.texelsPerDepth, at.off, lean);
  return isKnown ? share : min(far, share);
}
