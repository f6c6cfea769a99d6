// The height map: the bilinear interpolant of its texels, whose centres lie at + 0.5. Truth and bake
// use the same function. Filtered by hand from single texels, so that a mask does not depend on the
// precision of a GPU's filter.

uniform sampler2D heightMap;
uniform float searchRadius;  // how far tables are searched and the map is marched, texels
uniform vec2 heightBounds;   // the lowest and the highest texel, height units

struct Cell {
  vec4 heights;   // h00, h10, h01, h11
  vec2 fraction;  // place in the cell, 0 to 1
};

// The four texels come from one gather at the corner that they share, half a texel from where the
// choice of texels could depend on rounding; the sampler wraps as the map does.
// `texelSize` is 1 / the map's size.
Cell heightCell(vec2 at, vec2 texelSize) {
  vec2 corner = floor(at - 0.5);
  vec4 texels = textureGather(heightMap, (corner + 1.0) * texelSize);
  return Cell(texels.wzxy, at - 0.5 - corner);
}

Cell heightCell(vec2 at) { return heightCell(at, 1.0 / vec2(textureSize(heightMap, 0))); }

// The bilinear function of the heights of a cell's corners.
float heightIn(vec4 heights, vec2 fraction) {
  vec2 rows = mix(heights.xz, heights.yw, fraction.x);
  return mix(rows.x, rows.y, fraction.y);
}

float heightIn(Cell cell) { return heightIn(cell.heights, cell.fraction); }

// h(x, y), height units.
float heightAt(vec2 at) { return heightIn(heightCell(at)); }

// (∂h/∂x, ∂h/∂y) of the bilinear function, height units per texel.
vec2 gradientIn(Cell cell) {
  return vec2(mix(cell.heights.y - cell.heights.x, cell.heights.w - cell.heights.z, cell.fraction.y),
              mix(cell.heights.z - cell.heights.x, cell.heights.w - cell.heights.y, cell.fraction.x));
}

vec2 heightGradient(vec2 at) { return gradientIn(heightCell(at)); }

// How far along a path the relief is known, texels: as far as the border. Where no border lies ahead,
// 1e30. What the wrap rule puts past it casts no shadow, since there is no surface: tables are baked by
// the same rule. The path goes from `start` along `direction` + t `bend`, and reaches a border `ahead`
// where |d| t + b t² = ahead, b counted toward it.
float knownDistance(vec2 start, vec2 direction, vec2 bend) {
  vec2 size = vec2(textureSize(heightMap, 0));
  bvec2 isUp = greaterThan(direction, vec2(0.0));
  vec2 ahead = max(mix(start, size - start, isUp), 0.0);
  vec2 way = max(abs(direction), 1e-6);
  vec2 square = way * way + 4.0 * mix(-bend, bend, isUp) * ahead;
  vec2 there = 2.0 * ahead / (way + sqrt(max(square, 0.0)));
  vec2 known = mix(vec2(1e30), there, bvec2(ivec2(reliefBorder) * ivec2(greaterThanEqual(square, vec2(0.0)))));
  return min(known.x, known.y);
}

float knownDistance(vec2 start, vec2 direction) { return knownDistance(start, direction, vec2(0.0)); }

// N' of bump mapping (Blinn 1978): the normal of P + a h n, with the change of n left out.
vec3 bumpedNormal(Pixel pixel, vec2 gradient) {
  vec3 alongX = pixel.px + pixel.worldPerHeight * gradient.x * pixel.normal;
  vec3 alongY = pixel.py + pixel.worldPerHeight * gradient.y * pixel.normal;
  float side = dot(cross(pixel.px, pixel.py), pixel.normal) < 0.0 ? -1.0 : 1.0;
  return normalize(side * cross(alongX, alongY));
}
