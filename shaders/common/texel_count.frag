// How many texels the answer of every pixel reads: mask.frag's, or visibility.frag's.

layout(location = 0) out float texels;

void main() {
  Pixel pixel = makePixel();
  LocalLight light = makeLocalLight(pixel, lightDirection);
  bool isTurned = isTurnedAway(pixel);
#if defined ANSWER_SHARE || defined ANSWER_DISC
  if (lightRadius > 0.0) {
    float share = answeredShare(pixel, light);
  } else {
    bool isHidden = isShadowed(pixel, light);
  }
#else
  bool isHidden = isShadowed(pixel, light);
#endif
  texels = float(texelsRead);
}
