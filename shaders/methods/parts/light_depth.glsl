/* gnomon-part
passes = ["light-depth"]

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

// A disc as light. What stands D nearer to the light hides some of it where it lies within D tan ρ
// of the place, across the light. So the texels that are asked lie on a spiral, denser inward,
// where small D count too: the k-th of n at (k/n)² of the reach of all that the map can hold. Each
// counts where it lies within its own reach, and their mean D gives the radius of the penumbra, D
// tan ρ. The share of that disc which is not nearer is V (percentage-closer soft shadows, Fernando
// 2005, but for the reach). A disc smaller than a texel has no texels to count: there the bilinear
// share tells how far the outline is, share - ½ texels, and the closed form for a straight edge
// gives V.

// What hides some of the light, farther away than `beyond`: its mean D and its largest, in depth; 0 where
// nothing does.
vec2 blockerDistances(vec3 place, vec2 tilt, float reach, float beyond) {
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
    bool isBlocker = isNearer(place - vec3(0.0, 0.0, beyond), tilt, texel) &&
                     length(offset) <= reach * nearer + 1.0;
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
