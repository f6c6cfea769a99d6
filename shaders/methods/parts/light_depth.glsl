/* gnomon-part

[[pass]]
name = "place"
kind = "light"
channels = 2
about = "the place in the map of what the light sees, texels"

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

// The depth of a displaced mesh from the light: of a method with `light_mesh = "displaced"`.

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

vec2 passPlace(Pixel pixel, float depth) { return pixel.texel; }

// Where the depth map is asked for a pixel, and what of the relief its march has passed over: a parabola
// over the map from the pixel's place. What the light sees there the march knows better.
struct DepthPlace {
  vec3 place;            // in the map, A nearer to the light than the displaced point
  vec2 tilt;             // of the plane of its facet
  float off;             // u, world
  float allowance;       // A, world
  float less;            // by how much less is allowed to what is no part of the pixel's own surroundings, depth
  float near;            // t, what of the path is lost to the map, texels
  float texelsPerDepth;  // of the path, for a depth of 1
  float texelsPerWorld;  // of the map, in the tangent plane
  vec2 start, toward;    // of the march, texels
  vec2 end;              // `start` where there was none
};

// Squared, how far a place of the map is from where the march has passed, over what it may be off: 1 is the
// most. A blocker may be as far beside as the depth map is off, and a tenth of the way.
float besideMarch(DepthPlace at, vec2 texel) {
  vec2 chord = at.end - at.start;
  float square = max(dot(chord, chord), 1e-6);
#ifdef WRAP_REPEAT
  vec2 closes = vec2(closingAxes(textureSize(pointPass, 0)));
  texel -= closes * mapSize * round((texel - 0.5 * (at.start + at.end)) / mapSize);
#endif
  float place = dot(texel - at.start, chord) / square;
  float share = clamp(place, 0.0, 1.0);
  float along = sqrt(square) / max(dot(at.toward, chord) * inversesqrt(square), 0.5);
  vec2 off = texel - at.start - share * (along * at.toward + share * (chord - along * at.toward));
  float most = 1.0 + at.off * at.texelsPerWorld + (place < 1.0 ? 0.1 * share * sqrt(square) : 0.0);
  return dot(off, off) / (most * most);
}

// By how much a texel of the depth map is nearer to the light than the plane through the place: in depth, 0
// where it is not, or where the march knows.
float nearerAt(DepthPlace at, vec2 texel) {
  float nearer = at.place.z + dot(at.tilt, texel + 0.5 - at.place.xy) - lightDepthOf(ivec2(texel));
  if (nearer + at.less <= 0.0) return 0.0;
  vec2 seen = placeTexel(ivec2(texel));
  float world = max(nearer * lightMapLengths.y + at.allowance, 0.0);
  float way = distance(seen, at.start);
  bool isOther = way > 4.0 * at.texelsPerWorld * (world + 2.0 * at.off);
  nearer += isOther ? at.less : 0.0;
  bool isPassed = at.end != at.start && world * at.texelsPerWorld < 2.0 * (way + 2.0) && besideMarch(at, seen) < 1.0;
  return isPassed ? 0.0 : max(nearer, 0.0);
}

bool isNearer(DepthPlace at, vec2 texel) { return nearerAt(at, texel) > 0.0; }

// Share of such texels about a place, with bilinear weights (percentage-closer filtering): its half is
// a smooth outline, finer than the texels.
float shareNearer(DepthPlace at) {
  vec2 corner = floor(at.place.xy - 0.5);
  vec2 fraction = at.place.xy - 0.5 - corner;
  float share = 0.0;
  for (int k = 0; k < 4; ++k) {
    vec2 step = vec2(k & 1, k >> 1);
    vec2 weight = mix(1.0 - fraction, fraction, step);
    share += isNearer(at, corner + step) ? weight.x * weight.y : 0.0;
  }
  return share;
}

// A disc as light. What stands D nearer to the light hides some of it where it lies within D tan ρ
// of the place, across the light. So the texels that are asked lie on a spiral, denser inward,
// where small D count too: the k-th of n at (k/n)² of the reach of all that the map can hold. Each
// counts where it lies within its own reach, and their mean D gives the radius of the penumbra, D
// tan ρ. The share of that disc which is not nearer is V (percentage-closer soft shadows, Fernando
// 2005, but for the reach). A disc smaller than a texel has no texels to count: there the bilinear
// share tells how far the outline is, share - ½ texels, and the closed form for a straight edge
// gives V.

// What hides some of the light: its mean D and its largest, in depth; 0 where nothing does.
vec2 blockerDistances(DepthPlace at, float reach) {
  int count = int(search_samples);
  vec2 sum = vec2(0.0);  // number, D
  float most = 0.0;
  vec2 toward = vec2(1.0, 0.0);
  for (int k = 0; k < count; ++k) {
    float share = (float(k) + 0.5) / float(count);
    vec2 offset = reach * at.place.z * share * share * toward;
    toward = goldenTurn(toward);
    vec2 texel = floor(at.place.xy + offset);
    float nearer = at.place.z - lightDepthOf(ivec2(texel));
    bool isBlocker = isNearer(at, texel) && length(offset) <= reach * nearer + 1.0;
    sum += isBlocker ? vec2(1.0, nearer) : vec2(0.0);
    most = max(most, isBlocker ? nearer : 0.0);
  }
  return max(vec2(sum.y / max(sum.x, 1.0), most), 0.0);
}

// V by the depth map, with the penumbra's radius in its texels.
float shareByDepth(DepthPlace at, float radius) {
  float outline = 0.5 - shareNearer(at);
  if (radius <= 1.0) return discShare(outline / max(radius, 1e-3));
  int count = int(filter_samples);
  float nearer = 0.0;
  vec2 toward = vec2(radius, 0.0);
  for (int k = 0; k < count; ++k) {
    vec2 texel = floor(at.place.xy + sqrt((float(k) + 0.5) / float(count)) * toward);
    toward = goldenTurn(toward);
    nearer += isNearer(at, texel) ? 1.0 : 0.0;
  }
  return 1.0 - nearer / float(count);
}
