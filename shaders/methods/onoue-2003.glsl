/* gnomon-method
title = "Curvature-aware horizon and distance maps, convex parts only"
citation = "Onoue, Max & Nishita 2003"
family = "curvature"
symbol = "square"
tables = ["height", "horizon", "distance"]
*/

// The 2003 paper treats only surfaces that bend away from the normal, since on concave ones far
// parts of the surface itself cast shadows: where κ < 0 it falls back to the flat horizon map. Its
// printed (3) lacks the minus sign, a slip that the 2004 paper mends; the sign is kept here.

float horizonSlope(Pixel pixel, LocalLight light) {
  float curvature = max(normalCurvature(pixel, light.tangent), 0.0);          // (1), 1 / world
  float height = pixel.worldPerHeight * heightAt(pixel.texel);                // h, world
  float slope = pixel.worldPerHeight * horizonAt(pixel.texel, light.azimuth)  // tan β
                / light.worldPerTexel;
  float arcLength = distanceAt(pixel.texel, light.azimuth) * light.worldPerTexel;  // d, world

  float lowered = slope * (1.0 - curvature * height) - 0.5 * curvature * arcLength;  // (2)
  if (curvature > 0.0) lowered = max(lowered, bareHorizon(curvature, height));   // (3)
  return lowered;
}
