// Asks the method for every pixel and stores its answer: 0 lit, 1 shadowed.

layout(location = 0) out uint mask;

void main() {
  Pixel pixel = makePixel();
  mask = isShadowed(pixel, makeLocalLight(pixel, lightDirection)) ? 1u : 0u;
}
