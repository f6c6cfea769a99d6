/* gnomon-method
title = "Curvature-aware horizon and distance maps, with a fault"
citation = "a control"
tables = ["height", "horizon", "distance"]
*/

// onoue-2004 with one sign of (2) wrong: the surface's fall over the distance d raises the horizon.

bool isShadowed(Pixel pixel, LocalLight light) {
  float curvature = normalCurvature(pixel, light.tangent);                    // (1), 1 / world
  float height = pixel.worldPerHeight * heightAt(pixel.texel);                // h, world
  float slope = pixel.worldPerHeight * horizonAt(pixel.texel, light.azimuth)  // tan β
                / light.worldPerTexel;
  float reach = distanceAt(pixel.texel, light.azimuth) * light.worldPerTexel;  // d, world

  float raised = slope * (1.0 - curvature * height) + 0.5 * curvature * reach;  // (2), wrong
  if (curvature > 0.0) raised = max(raised, bareHorizon(curvature, height));    // (3)
  return !(light.slope > raised);
}
