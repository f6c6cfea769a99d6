/* gnomon-method
title = "Horizon and distance maps, exact on the osculating circle"
citation = "after Onoue, Max & Nishita 2004"
family = "curvature"
symbol = "triangle"
tables = ["height", "horizon", "distance"]
*/

// The lookups of the 2004 paper with its approximations undone: the occluder of height
// h₁ = h₀ + d tan β at arc length d stands on the osculating circle, seen without small angles and
// with the term that the paper drops from its denominator. One flat horizon a direction is left.

float horizonSlope(Pixel pixel, LocalLight light) {
  float curvature = normalCurvature(pixel, light.tangent);                    // (1), 1 / world
  float height = pixel.worldPerHeight * heightAt(pixel.texel);                // h₀, world
  float slope = pixel.worldPerHeight * horizonAt(pixel.texel, light.azimuth)  // tan β
                / light.worldPerTexel;
  float arcLength = distanceAt(pixel.texel, light.azimuth) * light.worldPerTexel;  // d, world

  float horizon = osculatingHorizon(curvature, height, slope, arcLength);
  if (curvature > 0.0) horizon = max(horizon, bareHorizon(curvature, height));  // (3)
  return horizon;
}
