// Where a map continues beyond its sides.

// The axes of the map at whose ends the surface ends too.
uniform bvec2 reliefBorder;
uniform vec2 mapSize;  // the map's width and height, texels

// A texel of a table: past a border the outermost one.
ivec2 wrapTexel(ivec2 at, ivec2 size) {
#ifdef WRAP_REPEAT
  at = mix(at, clamp(at, ivec2(0), size - 1), reliefBorder);
  // GLSL leaves the remainder of a negative number open.
  ivec2 beyond = max(at, ivec2(0)) % size;
  ivec2 before = size - 1 - max(-1 - at, ivec2(0)) % size;
  return mix(beyond, before, lessThan(at, ivec2(0)));
#else
  return clamp(at, ivec2(0), size - 1);
#endif
}
