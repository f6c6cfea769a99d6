// What follows from the functions that a method's file defines: its shadow test, and its share of the
// light's disc.

// What the method answered that is no answer, one bit each: 1 a share of light that is no number or
// not from 0 to 1, 2 a horizon that is no number, 4 a normal that is no unit vector.
uint answerFaults = 0u;

// By its bits: compilers take comparisons with what is no number as they like.
bool isNoNumber(float value) { return (floatBitsToUint(value) & 0x7fffffffu) > 0x7f800000u; }

#if defined ANSWER_SHARE || !defined OWN_TEST && !defined OWN_HORIZON
float checkedShare(Pixel pixel, LocalLight light) {
  const float rounding = 1e-4;  // of sums of shares
  float share = visibility(pixel, light);
  if (isNoNumber(share) || share < -rounding || share > 1.0 + rounding) answerFaults |= 1u;
  return share;
}
#endif

#ifdef OWN_HORIZON
float checkedHorizon(Pixel pixel, LocalLight light) {
  float slope = horizonSlope(pixel, light);
  if (isNoNumber(slope)) answerFaults |= 2u;
  return slope;
}
#endif

void checkNormal(Pixel pixel) {
#ifdef OWN_NORMAL
  const float rounding = 1e-2;
  vec3 normal = shadingNormal(pixel);
  float square = dot(normal, normal);
  if (isNoNumber(square) || abs(square - 1.0) > rounding) answerFaults |= 4u;
#endif
}

#ifndef OWN_TEST
#ifdef OWN_HORIZON
bool isShadowed(Pixel pixel, LocalLight light) {
  return !(light.slope > checkedHorizon(pixel, light));
}
#else
// The cut of equal areas: dark where less than half of the light is seen.
bool isShadowed(Pixel pixel, LocalLight light) { return !(checkedShare(pixel, light) >= 0.5); }
#endif
#endif

#ifdef ANSWER_DISC
// The horizon in the light's direction, as if it were straight across the disc.
float answeredShare(Pixel pixel, LocalLight light) {
  return shareOver(light.slope, checkedHorizon(pixel, light));
}
#endif

#ifdef ANSWER_SHARE
float answeredShare(Pixel pixel, LocalLight light) { return checkedShare(pixel, light); }
#endif
