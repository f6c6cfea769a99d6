// Horizon angles off the normal in RGBA maps, four azimuths each, and the lookup textures that go with
// them (Sloan & Cohen 2000, §4.1). An angle is a share of `angleLimit`, in the maps' own steps.

#ifdef TABLE_ANGLES

uniform sampler2DArray angleMaps;
uniform sampler2DArray basisMaps;   // B_k(s, t)
uniform sampler2DArray arccosMap;   // cosine, cos(limit) to 1, to angle
uniform int angleAzimuths;
uniform float angleLimit;           // radians
uniform float angleSteps;           // codes of a channel less one; 0 for floats
uniform ivec2 angleOrigin;          // texel coordinates of the maps' corner

// What a frame buffer or a texture of this many bits keeps of a value.
float toSteps(float value) {
  float kept = clamp(value, 0.0, 1.0);
  return angleSteps > 0.0 ? floor(kept * angleSteps + 0.5) / angleSteps : kept;
}

// Four azimuths' angles at one texel.
vec4 anglesOfTexel(ivec2 texel, int map) {
#ifdef UNIQUE_ANGLES
  ivec2 at = clamp(texel - angleOrigin, ivec2(0), textureSize(angleMaps, 0).xy - 1);
#else
  ivec2 at = wrapTexel(texel, textureSize(angleMaps, 0).xy);
#endif
  return texelFetch(angleMaps, ivec3(at, map), 0);
}

// Four azimuths' weights for a direction (s, t), bilinear.
vec4 basisOf(vec2 st, int map) {
  ivec2 last = textureSize(basisMaps, 0).xy - 1;
  vec2 place = clamp((0.5 * st + 0.5) * vec2(last + 1) - 0.5, vec2(0.0), vec2(last));
  ivec2 i = ivec2(place);
  ivec2 j = min(i + 1, last);
  vec2 f = place - vec2(i);
  vec4 low = mix(texelFetch(basisMaps, ivec3(i, map), 0),
                 texelFetch(basisMaps, ivec3(j.x, i.y, map), 0), f.x);
  vec4 high = mix(texelFetch(basisMaps, ivec3(i.x, j.y, map), 0),
                  texelFetch(basisMaps, ivec3(j, map), 0), f.x);
  return mix(low, high, f.y);
}

// The angle of a cosine by the one-dimensional map, linear between its entries.
float angleOfCosine(float cosine) {
  int last = textureSize(arccosMap, 0).x - 1;
  float lowest = cos(angleLimit);
  float place = clamp((cosine - lowest) / (1.0 - lowest), 0.0, 1.0) * float(last);
  int i = int(place);
  return mix(texelFetch(arccosMap, ivec3(i, 0, 0), 0).r,
             texelFetch(arccosMap, ivec3(min(i + 1, last), 0, 0), 0).r, place - float(i));
}

// The horizon's angle at a texel toward (s, t), eq. (1) of Sloan & Cohen 2000: Σ B_k φ_k. Each map's
// four products are summed in one pass, and passes add up in a frame buffer of the maps' bits.
float horizonAngleOfTexel(ivec2 texel, vec2 st) {
  float sum = 0.0;
  for (int map = 0; map * 4 < angleAzimuths; ++map) {
    sum = toSteps(sum + toSteps(dot(basisOf(st, map), anglesOfTexel(texel, map))));
  }
  return sum;
}

// The same at a pixel of the texture's plane toward the light, whose place on the tangent plane was
// found at the vertices.
float horizonAngleOfPixel(Pixel pixel) {
  vec2 st = vertexLight.xy / max(1.0, max(abs(vertexLight.x), abs(vertexLight.y)));
  return horizonAngleOfTexel(ivec2(floor(pixel.texel)), st);
}

#endif
