/* gnomon-method
title = "Checks of eight texels, by way of a texture"
citation = "a user's own file"
passes = ["texture"]
*/

float resolveTexel(Pixel pixel) {
  vec2 check = floor(pixel.texel / 8.0);
  return mod(check.x + check.y, 2.0);
}

bool isShadowed(Pixel pixel, LocalLight light) { return resolvedAt(pixel.texel) > 0.5; }
