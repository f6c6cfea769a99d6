/* gnomon-part
[[pass]]
name = "point"
kind = "texture"
channels = 3
about = "P, world"
*/

// The limit surface at a pixel: its point, and how its normal turns. The camera draws a coarse mesh,
// which lies below the surface where that is convex. Polygons as they are (ON_POLYGONS) are what is
// drawn; their points are displaced along a direction of their own, which hard edges share.

#ifdef ON_POLYGONS

layout(location = 12) in vec3 columnDirection;

// What the relief rises along at a pixel: unit vector.
vec3 columnAxis(Pixel pixel) { return normalize(columnDirection); }

vec3 surfacePoint(Pixel pixel) { return pixel.position; }

#else

vec3 columnAxis(Pixel pixel) { return pixel.normal; }

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

#endif

// n_x along a tangent vector of P_x's kind (Weingarten: the normal turns with the curvature).
vec3 turnOfNormal(Pixel pixel, vec3 along) {
  float first = dot(along, pixel.v1) / max(dot(pixel.v1, pixel.v1), 1e-30);
  float second = dot(along, pixel.v2) / max(dot(pixel.v2, pixel.v2), 1e-30);
  return pixel.k1 * first * pixel.v1 + pixel.k2 * second * pixel.v2;
}

// D_x or D_y of D = P + a h n, with all its terms: P_x + a h_x n + a h n_x. Bump mapping leaves out the last,
// which counts where the relief is as high as the body is thick. P_x, interpolated between corners, is not
// at right angles to n, and n is the more exact.
vec3 displacedSide(Pixel pixel, vec3 along, float rise, float height) {
  vec3 n = pixel.normal;
  return along + (rise - dot(along, n)) * n + height * turnOfNormal(pixel, along);
}

#ifdef ON_POLYGONS

// The normal of D = P + a h d from P and d themselves, which are linear on the drawn triangle: their
// changes per texel follow from those from pixel to pixel. N' where the triangle is seen from its edge.
// @param rise    of the relief per texel, world
// @param height  of the relief, world
vec3 displacedNormal(Pixel pixel, vec2 rise, float height) {
  vec3 d = columnAxis(pixel);
  mat2 texels = mat2(dFdx(texel), dFdy(texel));
  mat2x3 points = mat2x3(dFdx(position), dFdy(position));
  mat2x3 axes = mat2x3(dFdx(d), dFdy(d));
  float area = determinant(texels);
  if (!(area * area > 1e-8 * dot(texels[0], texels[0]) * dot(texels[1], texels[1]))) {
    return bumpedNormal(pixel, rise / pixel.worldPerHeight);
  }
  mat2 perTexel = inverse(texels);
  mat2x3 sides = (points + height * axes) * perTexel;
  vec3 facet = normalize(cross(sides[0] + rise.x * d, sides[1] + rise.y * d));
  return dot(facet, pixel.normal) < 0.0 ? -facet : facet;
}

#endif

vec3 passPoint(Pixel pixel) { return surfacePoint(pixel); }

// The axes along which the surface may close: the map repeats there, and covers it once.
bvec2 closingAxes(ivec2 size) {
#ifdef WRAP_REPEAT
  return bvec2(ivec2(not(reliefBorder)) * ivec2(equal(size, ivec2(mapSize))));
#else
  return bvec2(false);
#endif
}

// A texel at most one turn off, without a remainder, which is slow.
ivec2 wrapped(ivec2 texel, ivec2 size) {
  return texel + size * (ivec2(lessThan(texel, ivec2(0))) - ivec2(greaterThanEqual(texel, size)));
}

// How far a path stays on the pixel's chart, up to `end`, texels. Beyond a chart's border the map holds
// nothing, or another part of the surface: a point that is farther from the last than two texels are long.
float endOnChart(Pixel pixel, Path path, float end) {
  ivec2 size = textureSize(pointPass, 0);
  bvec2 closes = closingAxes(size);
  float most = 2.0 * (length(pixel.px) + length(pixel.py));
  vec3 last = surfacePoint(pixel);
  float known = 0.0;
  for (float t = 1.0; t < end + 1.0 && known < end; t += 1.0) {
    ivec2 texel = ivec2(floor(pathPoint(path, t))) - pointOrigin;
    vec4 there = passTexel(pointPass, mix(texel, wrapped(texel, size), closes), 0);
    bool isOwn = there.w > 0.0 && !isOfOtherChart(there.w) && distance(there.xyz, last) < most;
    if (!isOwn) return min(end, t - 0.5);
    last = there.xyz;
    known = t;
  }
  return end;
}
