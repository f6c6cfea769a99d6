/* gnomon-method
title = "Shadow from ambient occlusion, a cone of light"
citation = "Chan 2018, as in Filament"
tables = ["height", "horizon"]

[bakes.openness]
bits = 8
about = "share of the sky that a texel sees, weighted by the cosine to its normal: an ambient occlusion map"
*/

// An ambient occlusion map says how much of the sky a point sees, and not where. Taken as a cone about
// the normal, of the half angle α, it is A = sin² α, so that the light is in it where
// N·L > cos α = √(1 - A). Softened:
//   V = sat(N·L / √(1 - A))².
// The map is the same for all lights: a point in a pit is dark toward all sides alike.
//
// Chan's notes could not be read; this is Filament's computeMicroShadowing, whose comment cites them.
// N is the normal of the bump map. What an artist's occlusion map holds is left open: here it is
// baked from the exact horizons of the flat relief, over all of the search radius.

// The relief's normal at a texel by central differences, in the frame of angles (texelsPerHeight).
vec3 normalOfTexel(vec2 texel) {
  vec2 rise = vec2(heightAt(texel + vec2(1.0, 0.0)) - heightAt(texel - vec2(1.0, 0.0)),
                   heightAt(texel + vec2(0.0, 1.0)) - heightAt(texel - vec2(0.0, 1.0)));
  return normalize(vec3(-0.5 * texelsPerHeight * rise, 1.0));
}

// A = 1/π ∫ N·ω over the directions above the horizon β: with N = (n, N_z), in the azimuth e
//   ∫ N·ω cos ε dε from β to π/2 = N_z cos² β / 2 + n·e (π/2 - β - sin β cos β) / 2.
float bakeOpenness(vec2 texel) {
  vec3 facing = normalOfTexel(texel);
  int azimuths = textureSize(horizonTable, 0).z;
  float sum = 0.0;
  for (int m = 0; m < azimuths; ++m) {
    float slope = texelsPerHeight * tableEntry(horizonTable, horizonRange, ivec2(floor(texel)), m);
    float horizon = atan(slope);
    float azimuth = 2.0 * pi * float(m) / float(azimuths);
    float along = dot(facing.xy, vec2(cos(azimuth), sin(azimuth)));
    float cosine = cos(horizon);
    float area = 0.5 * pi - horizon - sin(horizon) * cosine;
    sum += 0.5 * (facing.z * cosine * cosine + along * area);
  }
  return clamp(2.0 * sum / float(azimuths), 0.0, 1.0);
}

float visibility(Pixel pixel, LocalLight light) {
  vec3 facing = bumpedNormal(pixel, heightGradient(pixel.texel));
  float cosine = dot(facing, lightDirection);
  float aperture = inversesqrt(max(1.0 - opennessAt(pixel.texel), 1e-8));
  float share = clamp(cosine * aperture, 0.0, 1.0);
  return share * share;
}
