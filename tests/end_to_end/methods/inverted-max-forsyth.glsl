/* gnomon-method
title = "Flat horizon map, upside down"
citation = "a control"
tables = ["horizon"]
*/

// Shadowed exactly where max-forsyth is lit.

bool isShadowed(Pixel pixel, LocalLight light) {
  float slope = pixel.worldPerHeight * horizonAt(pixel.texel, light.azimuth) / light.worldPerTexel;
  return light.slope > slope;
}
