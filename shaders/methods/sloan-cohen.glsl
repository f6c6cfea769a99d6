/* gnomon-method
title = "Interactive horizon mapping with tables of the flat relief"
citation = "Sloan & Cohen 2000, on planes"
family = "flat"
symbol = "square"
tables = ["angles"]
passes = ["texture"]
azimuths = 8
*/

// Eight azimuths of horizon angles in two RGBA maps. A pass in the texture's plane leaves the horizon's
// angle toward the light in a texture, by basis maps looked up with the light's place (s, t) on the
// tangent plane, which is found at the vertices. The camera's pass looks the light's own angle up from
// its interpolated cosine and subtracts. All in steps of 8 bits, as the hardware of the paper did; an
// angle is off the normal and at most 90°, so that a light below the tangent plane is never seen.
//
// The paper marks lit pixels in the stencil by an alpha test, and draws the surface again where the
// mark is. Here the test itself is the answer: what a stencil would keep, the mask keeps.
//
// The tables are the flat relief's and are laid over the surface again and again, as bump maps are. So
// they are Max's (1988) with the arithmetic of this paper: on curved surfaces the paper itself (§2)
// bakes the local geometry, which sloan-cohen-surface does. Angles are taken in one frame for all of
// the surface, of square texels over which a height unit is as many of them high as on the surface on
// average. The light is brought into it at the vertices.

float resolveTexel(Pixel pixel) { return horizonAngleOfPixel(pixel); }

// Where another chart has the texels, that pass was another light's: the pixel's own texel is asked.
float horizonAngle(Pixel pixel) {
  return resolvedOtherChartAt(pixel.texel) ? horizonAngleOfPixel(pixel) : resolvedAt(pixel.texel);
}

bool isShadowed(Pixel pixel, LocalLight light) {
  float horizon = horizonAngle(pixel);
  return !(toSteps(horizon - angleOfCosine(vertexLight.w)) > 0.0);
}

// The same horizon as a slope in the world, whose light is the pixel's own and not in steps.
float horizonSlope(Pixel pixel, LocalLight light) {
  float angle = angleLimit * horizonAngle(pixel);
  float slope = cos(angle) / max(sin(angle), 1e-9);
  return slope * pixel.worldPerHeight / (light.worldPerTexel * texelsPerHeight);
}
