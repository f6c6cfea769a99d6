/* gnomon-part
tables = ["height", "horizon"]

[bakes.openness]
bits = 8
about = "share of the sky that a texel sees, weighted by the cosine to its normal: an ambient occlusion map"
*/

// An ambient occlusion map, baked from the exact horizons of the flat relief.

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
