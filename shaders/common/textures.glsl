// Pictures that a method brings. They repeat, and are read between texels by hand. Every
// [textures.NAME] adds a uniform `nameTexture` and the functions `nameAt` and `nameTexel`, which call
// these.

#ifdef OWN_TEXTURES

// A texel of a picture, its lowest row 0.
vec4 pictureTexel(sampler2D picture, ivec2 at) {
  ivec2 size = textureSize(picture, 0);
  // GLSL leaves the remainder of a negative number open.
  ivec2 before = size - 1 - max(-1 - at, ivec2(0)) % size;
  return texelFetch(picture, mix(max(at, ivec2(0)) % size, before, lessThan(at, ivec2(0))), 0);
}

// The texel that holds a place, in texels of the picture.
vec4 pictureNear(sampler2D picture, vec2 at) { return pictureTexel(picture, ivec2(floor(at))); }

// Bilinear there.
vec4 pictureAt(sampler2D picture, vec2 at) {
#ifdef FILTER_HARDWARE
  return textureLod(picture, at / vec2(textureSize(picture, 0)), 0.0);
#else
  vec2 corner = floor(at - 0.5);
  vec2 fraction = at - 0.5 - corner;
  ivec2 i = ivec2(corner);
  vec4 low = mix(pictureTexel(picture, i), pictureTexel(picture, i + ivec2(1, 0)), fraction.x);
  vec4 high =
      mix(pictureTexel(picture, i + ivec2(0, 1)), pictureTexel(picture, i + ivec2(1, 1)), fraction.x);
  return mix(low, high, fraction.y);
#endif
}

#endif
