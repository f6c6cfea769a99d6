/* gnomon-method
title = "Ambient aperture lighting"
citation = "Oat & Sander 2007"
family = "engine"
symbol = "triangle"
tables = ["horizon"]

[bakes.aperture]
channels = 4
bits = 8
range = [[-1, 1], [-1, 1], [-1, 1], [0, 1]]
about = "mean direction of the sky that a texel sees, and the cosine of the radius of a cap of its size"
*/

// The sky that a texel sees is stored as a spherical cap: its centre is the mean visible direction,
// its area the visible one. The light is a cap too, and V is the share of it within the first. The area
// of two caps' intersection, radii r₀, r₁ and centres d apart, is the smaller cap's times
//   1 where one holds the other, 0 where d ≥ r₀ + r₁,
//   smoothstep(0, 1, 1 - (d - |r₀ - r₁|) / (r₀ + r₁ - |r₀ - r₁|)) between.
// What is seen in fact is rarely a cap: a wall leaves half of the sky, and its cap reaches into it.
//
// Presented in 2006 and published in 2007. The abstract, the talk's outline and renderers that follow
// them could be read. How directions are stored is left open. Here caps are of the flat relief, of all
// that stands above its horizons.

// Mean direction of what is seen above the horizons β in all azimuths, and 1 - its solid angle / 2π:
//   ∫ ω cos ε dε = (e (π/2 - β - sin β cos β), cos² β) / 2,   ∫ cos ε dε = 1 - sin β.
vec4 bakeAperture(vec2 texel) {
  int azimuths = textureSize(horizonTable, 0).z;
  vec3 mean = vec3(0.0);
  float hidden = 0.0;
  for (int m = 0; m < azimuths; ++m) {
    float slope = texelsPerHeight * tableEntry(horizonTable, horizonRange, ivec2(floor(texel)), m);
    float horizon = atan(slope);
    float azimuth = 2.0 * pi * float(m) / float(azimuths);
    float cosine = cos(horizon);
    float area = 0.5 * pi - horizon - sin(horizon) * cosine;
    mean += vec3(area * vec2(cos(azimuth), sin(azimuth)), cosine * cosine);
    hidden += sin(horizon) / float(azimuths);
  }
  float size = length(mean);
  return vec4(size > 0.0 ? mean / size : vec3(0.0, 0.0, 1.0), clamp(hidden, 0.0, 1.0));
}

float visibility(Pixel pixel, LocalLight light) {
  vec4 aperture = apertureAt(pixel.texel);
  float slope = texelsPerHeight * light.slope * light.worldPerTexel / pixel.worldPerHeight;
  vec3 toward = normalize(vec3(light.direction, clamp(slope, -1e9, 1e9)));
  vec3 centre = aperture.xyz;
  float apart = atan(length(cross(centre, toward)), dot(centre, toward));
  float sky = atan(sqrt(max(1.0 - aperture.w * aperture.w, 0.0)), aperture.w);
  float within = abs(sky - lightRadius);
  float between = sky + lightRadius - within;
  // A point, and what one cap holds, leave nothing between.
  float overlap = between > 0.0 ? smoothstep(0.0, 1.0, 1.0 - (apart - within) / between)
                                : (apart < within ? 1.0 : 0.0);
  float held = (1.0 - aperture.w) / max(1.0 - cos(lightRadius), 1e-20);
  return overlap * min(held, 1.0);
}
