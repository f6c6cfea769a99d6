/* gnomon-method
title = "My shadow"
citation = "me"
tables = ["horizon"]

[parameters.bias]
default = 0.02
minimum = 0
maximum = 1
about = "slope that the horizon must exceed the light by"
*/

// A flat horizon map with a bias. docs/method-reference.md of Gnomon lists what a method may call.
bool isShadowed(Pixel pixel, LocalLight light) {
  float slope = pixel.worldPerHeight * horizonAt(pixel.texel, light.azimuth) / light.worldPerTexel;
  return slope - light.slope > bias;
}
