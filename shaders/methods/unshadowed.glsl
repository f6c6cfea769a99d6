/* gnomon-method
title = "Bump mapping alone"
citation = "Blinn 1978"
tables = ["height"]
*/

// No bump casts a shadow: only what bump mapping itself turns from the light is dark. The control
// that every gate must fail.

bool isShadowed(Pixel pixel, LocalLight light) {
  return dot(bumpedNormal(pixel, heightGradient(pixel.texel)), lightDirection) <= 0.0;
}
