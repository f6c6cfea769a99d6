/* gnomon-method
title = "Flat horizon map with a bias"
citation = "a user's own file"
tables = ["horizon"]

[parameters.bias]
default = 0.0
minimum = -2.0
maximum = 2.0
about = "added to the horizon's tangent"
*/

bool isShadowed(Pixel pixel, LocalLight light) {
  float slope = pixel.worldPerHeight * horizonAt(pixel.texel, light.azimuth) / light.worldPerTexel;
  return !(light.slope > slope + bias);
}
