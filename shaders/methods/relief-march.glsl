/* gnomon-method
title = "Height map marched toward the light"
citation = "as engines do, after Tatarchuk 2006"
family = "march"
symbol = "circle"
*/

// What engines ship: the ray to the light over the flat relief, sampled at even steps until it has
// left the highest bump below it, or as far as is searched where it never does.

#include "parts/even_march.glsl"

bool isShadowed(Pixel pixel, LocalLight light) { return shadowedOnTheWay(pixel, light); }

float visibility(Pixel pixel, LocalLight light) { return shareOnTheWay(pixel, light); }
