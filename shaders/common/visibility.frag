// Both answers for every pixel as shares of the light's disc, 0 to 1. `test`: what the method says.
// `drawn`: in its picture the disc also sets behind the plane of the normal that it is shaded with, as
// a straight horizon at elevation 0. What is no answer (answers.glsl) is less than -1 in `test`.

layout(location = 0) out float drawn;
layout(location = 1) out float test;
layout(location = 2) out uint otherChart;  // 1 where it met a texel of another chart

void main() {
  Pixel pixel = makePixel();
  float sine = dot(shadingNormal(pixel), lightDirection);
  float elevation = atan(sine, sqrt(max(1.0 - sine * sine, 0.0)));
  float share = answeredShare(pixel, makeLocalLight(pixel, lightDirection));
  test = share > 0.0 ? min(share, 1.0) : 0.0;
  drawn = min(test, discShare(elevation / lightRadius));
  checkNormal(pixel);
  if (answerFaults != 0u) test = -1.0 - float(answerFaults);
  otherChart = hasMetOtherChart ? 1u : 0u;
}
