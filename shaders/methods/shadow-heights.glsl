/* gnomon-method
title = "Heights at which the light ends, two a texel"
citation = "Community Shaders for Skyrim, terrain shadows; OGRE's Terra alike"
family = "engine"
symbol = "pentagon"
tables = ["height"]

[[pass]]
name = "ends"
kind = "texture"
channels = 2
about = "heights over a texel from which all of the light is seen, and from which on some of it is"
*/

// What open worlds do with their terrain: for every texel of the map two heights are kept, while the
// sun stands still. What is above the upper one sees all of the sun, what is below the lower one sees
// none of it, and between them V is linear in the height h:
//   upper = max h(t) - t tan(θ - ρ),   lower = max h(t) - t tan(θ + ρ),
//   V = sat((h - lower) / (upper - lower)),
// over the distances t toward the sun, a texel from each to the next. Whatever stands there, trees and
// houses too, asks the same two heights.
//
// Read from these programs' shaders, which carry the heights on from texel to texel along the light's
// way. They lower them by a constant, so that terrain does not shade itself; here the maximum leaves
// out the texel's own height in place of that. The light is the texel's own, in the frame of the
// surface: for a plain terrain it is one.

vec2 passEnds(Pixel pixel) {
  LocalLight light = makeLocalLight(pixel, lightDirection);
  float scale = light.worldPerTexel / pixel.worldPerHeight;  // height units per texel, of slope 1
  float tangent = tan(lightRadius);
  vec2 rise = scale * vec2(slopeTurned(light.slope, -tangent), slopeTurned(light.slope, tangent));
  float farthest = min(searchRadius, knownDistance(pixel.texel, light.direction));
  vec2 ends = vec2(-1e9);
  for (float t = 1.0; t <= farthest; t += 1.0) {
    if (heightBounds.y - t * rise.x < ends.x && rise.x > 0.0) break;
    ends = max(ends, heightAt(pixel.texel + t * light.direction) - t * rise);
  }
  return ends;
}

// Where another chart has the texels, the heights are the pixel's own.
float visibility(Pixel pixel, LocalLight light) {
  vec2 ends = endsOtherChartAt(pixel.texel) ? passEnds(pixel) : endsAt(pixel.texel);
  float over = heightAt(pixel.texel) - ends.y;
  float between = ends.x - ends.y;
  return between > 0.0 ? clamp(over / between, 0.0, 1.0) : (over > 0.0 ? 1.0 : 0.0);
}
