/* gnomon-method
title = "Elliptical cones of light"
citation = "Kautz, Heidrich & Daubert 2000"
tables = ["ellipse"]
*/

// Lit where the light's direction, projected along the normal onto the tangent plane, lies in the
// ellipse that stands for the directions the texel is lit from. The direction is taken in the frame in
// which the flat relief was looked at: texels are squares, and a height unit is as many of them high
// as on the surface on average. The plane knows no direction below it.

bool isShadowed(Pixel pixel, LocalLight light) {
  if (!(light.slope > 0.0)) return true;
  float slope = texelsPerHeight * light.slope * light.worldPerTexel / pixel.worldPerHeight;
  vec2 direction = light.direction / sqrt(1.0 + slope * slope);
  Ellipse ellipse = ellipseAt(pixel.texel);
  float area = determinant(ellipse.spread);
  if (!(area > 0.0)) return true;
  vec2 place = inverse(ellipse.spread) * (direction - ellipse.centre);
  return !(dot(place, place) <= 1.0);
}
