/* gnomon-method
title = "Interactive horizon mapping, tables of the real geometry"
citation = "Sloan & Cohen 2000, §2 on curved surfaces and §3"
family = "flat"
symbol = "triangle"
tables = ["surface-angles"]
passes = ["texture"]
azimuths = 8
*/

// As sloan-cohen, with horizons that rays found on the displaced surface itself, every texel of it
// unique: curvature, and all else that shades a texel, is in the table. What is left are the table's
// steps, its azimuths and its texels. With many azimuths and bits it bounds what a table can do.

float resolveTexel(Pixel pixel) { return horizonAngleOfPixel(pixel); }

// Where another chart has the texels, so it has in the table: the limit is all that is known.
float horizonAngle(Pixel pixel) {
  return resolvedOtherChartAt(pixel.texel) ? 1.0 : resolvedAt(pixel.texel);
}

bool isShadowed(Pixel pixel, LocalLight light) {
  float horizon = horizonAngle(pixel);
  return !(toSteps(horizon - angleOfCosine(vertexLight.z)) > 0.0);
}

// The same horizon as a slope; its light is the pixel's own and not in steps.
float horizonSlope(Pixel pixel, LocalLight light) {
  float angle = angleLimit * horizonAngle(pixel);
  return cos(angle) / max(sin(angle), 1e-9);
}
