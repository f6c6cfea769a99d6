// What the passes before this one left, for methods that declare them.

#ifdef PASS_TEXTURE

uniform sampler2D resolvedMap;   // the method's value, and 1 where the surface has the texel
uniform ivec2 resolvedOrigin;    // texel coordinates of its corner

// The texture pass's value, bilinear between the texels that the surface has.
float resolvedAt(vec2 texel) {
  vec2 corner = floor(texel - 0.5);
  vec2 fraction = texel - 0.5 - corner;
  ivec2 last = textureSize(resolvedMap, 0) - 1;
  float sum = 0.0;
  float weights = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 step = ivec2(k & 1, k >> 1);
    vec2 entry = texelFetch(resolvedMap,
                            clamp(ivec2(corner) - resolvedOrigin + step, ivec2(0), last), 0).rg;
    vec2 along = mix(1.0 - fraction, fraction, vec2(step));
    float weight = entry.g > 0.0 ? along.x * along.y : 0.0;
    sum += weight * entry.r;
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

#endif

#ifdef PASS_LIGHT_DEPTH

uniform sampler2D lightDepthMap;   // 0 nearest to the light, 1 farthest
uniform mat4 lightMapFromWorld;    // to texels of the map and depth
uniform vec2 lightMapLengths;      // world length of one texel, and of depth 1

// A world point in the map: texels and depth.
vec3 lightMapPlace(vec3 world) { return (lightMapFromWorld * vec4(world, 1.0)).xyz; }

// The depth that the light sees at a texel of the map.
float lightDepthOf(ivec2 texel) {
  return texelFetch(lightDepthMap, clamp(texel, ivec2(0), textureSize(lightDepthMap, 0) - 1), 0).r;
}

// Change of depth per texel of the map along a plane, by its normal and that normal's cosine to the
// light, above 0. The first two rows of the map's matrix are its axes in the world over a texel's
// length.
vec2 lightMapTilt(vec3 facet, float cosine) {
  mat3 axes = transpose(mat3(lightMapFromWorld));
  float texel = lightMapLengths.x;
  vec2 across = texel * vec2(dot(facet, axes[0]), dot(facet, axes[1]));
  return across * texel / (lightMapLengths.y * cosine);
}

#endif

#ifdef PASS_SHADOW_VOLUMES

uniform usampler2D shadowCounts;

// Shadow volumes that hold this pixel's point.
uint shadowCount() { return texelFetch(shadowCounts, ivec2(gl_FragCoord.xy), 0).r; }

#endif
