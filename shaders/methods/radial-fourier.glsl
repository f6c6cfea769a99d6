/* gnomon-method
title = "Horizons as a radial Fourier series"
citation = "OneEightHundred 2010"
family = "engine"
symbol = "plus"
tables = ["horizon"]

[bakes.first]
channels = 4
bits = 8
range = [-1, 1]
about = "c0, s1, c1 and s2 of the series"

[bakes.last]
bits = 8
range = [-1, 1]
about = "c2 of the series"
*/

// The horizon of a texel as a wave over the azimuth φ, of which five Fourier coefficients are stored:
//   g(φ) = c0 + s1 sin φ + c1 cos φ + s2 sin 2φ + c2 cos 2φ,   sin β = g |g|.
// The square root, with its sign, keeps precision at low horizons. A wall's edge is a step in φ, and
// five coefficients smear it over a right angle.
//
// From the author's web log, "Self-shadowing textures using radial horizon maps". There the hard test
// may be softened by a constant of one's choice, which is left out. The range of the codes is left
// open: here it is [-1, 1], and s1 and c1, up to 4/π in theory, are cut at its ends.

// g of a texel in an azimuth.
float waveOf(vec2 texel, int m) {
  float slope = texelsPerHeight * tableEntry(horizonTable, horizonRange, ivec2(floor(texel)), m);
  float sine = slope * inversesqrt(1.0 + slope * slope);
  return sign(sine) * sqrt(abs(sine));
}

vec4 bakeFirst(vec2 texel) {
  int azimuths = textureSize(horizonTable, 0).z;
  vec4 sum = vec4(0.0);
  for (int m = 0; m < azimuths; ++m) {
    float azimuth = 2.0 * pi * float(m) / float(azimuths);
    vec4 basis = vec4(0.5, sin(azimuth), cos(azimuth), sin(2.0 * azimuth));
    sum += waveOf(texel, m) * basis;
  }
  return 2.0 * sum / float(azimuths);
}

float bakeLast(vec2 texel) {
  int azimuths = textureSize(horizonTable, 0).z;
  float sum = 0.0;
  for (int m = 0; m < azimuths; ++m) {
    sum += waveOf(texel, m) * cos(4.0 * pi * float(m) / float(azimuths));
  }
  return 2.0 * sum / float(azimuths);
}

float horizonSlope(Pixel pixel, LocalLight light) {
  float x = light.direction.y;  // sin φ
  float y = light.direction.x;
  vec4 basis = vec4(1.0, x, y, 2.0 * x * y);
  float wave = dot(firstAt(pixel.texel), basis) + lastAt(pixel.texel) * (y * y - x * x);
  float sine = clamp(wave * abs(wave), -1.0, 1.0);
  float slope = sine * inversesqrt(max(1.0 - sine * sine, 1e-12));
  return slope * pixel.worldPerHeight / (light.worldPerTexel * texelsPerHeight);
}
