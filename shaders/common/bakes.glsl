// Tables that a method bakes by functions of its own, read between texels by hand, so that a mask does
// not depend on a GPU's filter. Every [bakes.NAME] adds a uniform `nameBake` and the functions `nameAt`
// and `nameTexel`, which call these.

#ifdef OWN_BAKES

// The stored value of one texel of a level; codes are 0 to 1. Wraps as the map does.
vec4 bakedTexel(sampler2DArray bake, ivec2 at, int layer, int level) {
  ivec3 size = textureSize(bake, level);
  return texelFetch(bake, ivec3(wrapTexel(at, size.xy), clamp(layer, 0, size.z - 1)), level);
}

// The same of the texel that holds a place of the map.
vec4 bakedNear(sampler2DArray bake, vec2 at, int layer, int level) {
  vec2 place = at / mapSize * vec2(textureSize(bake, level).xy);
  return bakedTexel(bake, ivec2(floor(place)), layer, level);
}

// Of a level between two the finer one.
vec4 bakedNear(sampler2DArray bake, vec2 at, int layer, float level) {
  int last = textureQueryLevels(bake) - 1;
  return bakedNear(bake, at, layer, int(clamp(level, 0.0, float(last))));
}

// Bilinear in a level, at a place in texels of the map.
vec4 bakedAt(sampler2DArray bake, vec2 at, int layer, int level) {
#ifdef FILTER_HARDWARE
  return textureLod(bake, vec3(at / mapSize, float(layer)), float(level));
#else
  vec2 place = at / mapSize * vec2(textureSize(bake, level).xy) - 0.5;
  vec2 corner = floor(place);
  vec2 fraction = place - corner;
  ivec2 i = ivec2(corner);
  vec4 low = mix(bakedTexel(bake, i, layer, level), bakedTexel(bake, i + ivec2(1, 0), layer, level),
                 fraction.x);
  vec4 high = mix(bakedTexel(bake, i + ivec2(0, 1), layer, level),
                  bakedTexel(bake, i + ivec2(1, 1), layer, level), fraction.x);
  return mix(low, high, fraction.y);
#endif
}

// Linear between levels, too.
vec4 bakedAt(sampler2DArray bake, vec2 at, int layer, float level) {
#ifdef FILTER_HARDWARE
  return textureLod(bake, vec3(at / mapSize, float(layer)), level);
#else
  float last = float(textureQueryLevels(bake) - 1);
  float within = clamp(level, 0.0, last);
  int finer = int(within);
  return mix(bakedAt(bake, at, layer, finer), bakedAt(bake, at, layer, min(finer + 1, int(last))),
             within - float(finer));
#endif
}

#endif
