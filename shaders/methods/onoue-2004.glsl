/* gnomon-method
title = "Curvature-aware horizon and distance maps"
citation = "Onoue, Max & Nishita 2004"
family = "curvature"
symbol = "circle"
tables = ["height", "horizon", "distance"]
*/

// The horizon of the flat relief, lowered by the surface's fall over the distance d to the horizon
// point; or the horizon of the bare surface, where that is higher.
//
// (3) is the horizon of a convex surface seen from a height h ≥ 0 over it. On a concave one it has no
// meaning (its root is imaginary), and below the bare surface it is clamped to h = 0. At h = 0 on a
// convex surface it gives 0: bare ground beyond the terminator is dark.

float horizonSlope(Pixel pixel, LocalLight light) {
  float curvature = normalCurvature(pixel, light.tangent);                    // (1), 1 / world
  float height = pixel.worldPerHeight * heightAt(pixel.texel);                // h, world
  float slope = pixel.worldPerHeight * horizonAt(pixel.texel, light.azimuth)  // tan β
                / light.worldPerTexel;
  float arcLength = distanceAt(pixel.texel, light.azimuth) * light.worldPerTexel;  // d, world

  float lowered = slope * (1.0 - curvature * height) - 0.5 * curvature * arcLength;  // (2)
  if (curvature > 0.0) lowered = max(lowered, bareHorizon(curvature, height));   // (3)
  return lowered;
}
