// What the passes before this one left, for methods that declare them.

// A pass over the texture stores one point of the surface a texel. Where charts of the texture lie over
// each other a texel is that of the chart whose face comes first in the mesh: for the others it holds
// a point of somewhere else. So every texel has a mark: the number of its chart, 0 where the surface
// has no such texel.

uniform bool chartsOverlap;  // else all texels that a pixel may meet are its own

// Whether the answer of this pixel met a texel of another chart. A run reports how many do.
bool hasMetOtherChart = false;

// Whether a texel is another chart's than the pixel's, by its mark.
bool isOfOtherChart(float mark) {
  bool isOther = chartsOverlap && chart > 0 && mark > 0.0 && mark != float(chart);
  hasMetOtherChart = hasMetOtherChart || isOther;
  return isOther;
}

#if defined(PASS_TEXTURE) || defined(OWN_PASSES)

// A texel of a level of a pass's target; beyond its sides the outermost.
vec4 passTexel(sampler2D target, ivec2 at, int level) {
  return texelFetch(target, clamp(at, ivec2(0), textureSize(target, level) - 1), level);
}

// Bilinear in a level, at a place in texels of the target.
vec4 passAt(sampler2D target, vec2 at, int level) {
#ifdef FILTER_HARDWARE
  return textureLod(target, at / vec2(textureSize(target, 0)), float(level));
#else
  vec2 place = at / vec2(textureSize(target, 0)) * vec2(textureSize(target, level)) - 0.5;
  vec2 corner = floor(place);
  vec2 fraction = place - corner;
  ivec2 i = ivec2(corner);
  vec4 low = mix(passTexel(target, i, level), passTexel(target, i + ivec2(1, 0), level), fraction.x);
  vec4 high = mix(passTexel(target, i + ivec2(0, 1), level), passTexel(target, i + ivec2(1, 1), level),
                  fraction.x);
  return mix(low, high, fraction.y);
#endif
}

// Linear between levels, too.
vec4 passAt(sampler2D target, vec2 at, float level) {
#ifdef FILTER_HARDWARE
  return textureLod(target, at / vec2(textureSize(target, 0)), level);
#else
  float last = float(textureQueryLevels(target) - 1);
  float within = clamp(level, 0.0, last);
  int finer = int(within);
  return mix(passAt(target, at, finer), passAt(target, at, min(finer + 1, int(last))),
             within - float(finer));
#endif
}

// Bilinear between the texels that the surface has, which a channel marks, without those of another
// chart, at a place in texels of the texture; `origin` is the target's corner there. 0 where there is
// none of them.
vec4 markedAt(sampler2D target, ivec2 origin, vec2 at, int mark) {
  vec2 corner = floor(at - 0.5);
  vec2 fraction = at - 0.5 - corner;
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 step = ivec2(k & 1, k >> 1);
    vec4 entry = passTexel(target, ivec2(corner) - origin + step, 0);
    vec2 along = mix(1.0 - fraction, fraction, vec2(step));
    bool counts = entry[mark] > 0.0 && !isOfOtherChart(entry[mark]);
    float weight = counts ? along.x * along.y : 0.0;
    sum += weight * entry;
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : vec4(0.0);
}

// Whether one of the four texels about a place is another chart's: what a pass stored there is not
// known for this pixel.
bool otherChartAt(sampler2D target, ivec2 origin, vec2 at, int mark) {
  if (!chartsOverlap) return false;
  ivec2 corner = ivec2(floor(at - 0.5)) - origin;
  bool isOther = false;
  for (int k = 0; k < 4; ++k) {
    isOther = isOfOtherChart(passTexel(target, corner + ivec2(k & 1, k >> 1), 0)[mark]) || isOther;
  }
  return isOther;
}

#endif

#ifdef PASS_TEXTURE

uniform sampler2D resolvedMap;   // the method's value, and the texel's mark
uniform ivec2 resolvedOrigin;    // texel coordinates of its corner

// The texture pass's value, bilinear between the texels that the surface has.
float resolvedAt(vec2 texel) { return markedAt(resolvedMap, resolvedOrigin, texel, 1).r; }

// Whether one of the texels about a place is another chart's, so that its value is not the pixel's.
bool resolvedOtherChartAt(vec2 texel) { return otherChartAt(resolvedMap, resolvedOrigin, texel, 1); }

#endif

#ifdef NEEDS_CAMERA

uniform vec3 eyePosition;  // world

// From a pixel's point to the eye: unit vector, world.
vec3 viewDirection(Pixel pixel) { return normalize(eyePosition - pixel.position); }

#endif

#ifdef PASS_CAMERA_DEPTH

uniform sampler2D cameraDepthMap;   // 0 at the near plane, 1 at the far plane and where nothing is
uniform mat4 cameraMapFromWorld;    // to pixels and depth, before the division by w
uniform mat4 worldFromCameraMap;    // back

// A world point in the camera's picture: pixels and depth. What lies behind the eye has no place: -1e9.
vec3 cameraPlace(vec3 world) {
  vec4 place = cameraMapFromWorld * vec4(world, 1.0);
  return place.w > 0.0 ? place.xyz / place.w : vec3(-1e9);
}

// The depth that the camera sees at a pixel.
float cameraDepthOf(ivec2 pixel) {
  return texelFetch(cameraDepthMap, clamp(pixel, ivec2(0), textureSize(cameraDepthMap, 0) - 1), 0).r;
}

// The world point of a place in the picture.
vec3 cameraPoint(vec3 place) {
  vec4 world = worldFromCameraMap * vec4(place, 1.0);
  return world.xyz / world.w;
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
