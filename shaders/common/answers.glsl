// What follows from the functions that a method's file defines: its shadow test, and its share of the
// light's disc.

#ifndef OWN_TEST
#ifdef OWN_HORIZON
bool isShadowed(Pixel pixel, LocalLight light) {
  return !(light.slope > horizonSlope(pixel, light));
}
#else
// The cut of equal areas: dark where less than half of the light is seen.
bool isShadowed(Pixel pixel, LocalLight light) { return !(visibility(pixel, light) >= 0.5); }
#endif
#endif

#ifdef ANSWER_DISC
// The horizon in the light's direction, as if it were straight across the disc.
float answeredShare(Pixel pixel, LocalLight light) {
  return shareOver(light.slope, horizonSlope(pixel, light));
}
#endif

#ifdef ANSWER_SHARE
float answeredShare(Pixel pixel, LocalLight light) { return visibility(pixel, light); }
#endif
