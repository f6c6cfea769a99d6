/* gnomon-method
title = "Horizons of four azimuths, linear in angle"
citation = "Stellarium, the Moon's shader"
family = "engine"
symbol = "cross"
tables = ["horizon"]
azimuths = 4

[bakes.horizons]
channels = 4
bits = 8
range = [-1, 1]
about = "square root, with its sign, of the sine of the horizon in four azimuths"
*/

// Four channels hold the horizon in four azimuths, a right angle apart: the square root of sin β with
// its sign, in 8 bits, which the texture's filter interpolates. The angle toward the light is linear
// between those of the two azimuths beside it, and the light is seen where it stands no lower. Its
// disc is left out: the light is a point.
//
// Read from Stellarium's planet.frag (2023). Its map is that of the Moon's globe, so that the horizon
// of the globe itself is in it. Here it is the flat relief's, laid over the surface, as all maps are.

vec4 bakeHorizons(vec2 texel) {
  int azimuths = textureSize(horizonTable, 0).z;
  vec4 roots;
  for (int k = 0; k < 4; ++k) {
    int m = k * azimuths / 4;
    float slope = texelsPerHeight * tableEntry(horizonTable, horizonRange, ivec2(floor(texel)), m);
    float sine = slope * inversesqrt(1.0 + slope * slope);
    roots[k] = sign(sine) * sqrt(abs(sine));
  }
  return roots;
}

float horizonSlope(Pixel pixel, LocalLight light) {
  vec4 roots = horizonsAt(pixel.texel);
  float place = light.azimuth / (0.5 * pi);
  int below = int(floor(place)) % 4;
  vec4 sines = clamp(roots * abs(roots), -1.0, 1.0);
  float angle = mix(asin(sines[below]), asin(sines[(below + 1) % 4]), fract(place));
  float slope = sin(angle) / max(cos(angle), 1e-9);
  return slope * pixel.worldPerHeight / (light.worldPerTexel * texelsPerHeight);
}
