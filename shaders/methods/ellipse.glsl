/* gnomon-method
title = "Elliptical cones of light"
citation = "Kautz, Heidrich & Daubert 2000"
family = "flat"
symbol = "inverted-triangle"
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

// The far side of the ellipse along e is the lowest direction that is lit:
//   |A⁻¹ (r e - c)| = 1,   tan β = √(1 - r²) / r in that frame,
// with the plane itself where the ellipse reaches past it. Its near side, over the light, is no horizon.
float horizonSlope(Pixel pixel, LocalLight light) {
  Ellipse ellipse = ellipseAt(pixel.texel);
  if (!(determinant(ellipse.spread) > 0.0)) return 1e9;
  mat2 narrow = inverse(ellipse.spread);
  vec2 along = narrow * light.direction;
  vec2 centre = narrow * ellipse.centre;
  float square = dot(along, along);
  float middle = dot(along, centre);
  float root = middle * middle - square * (dot(centre, centre) - 1.0);
  float far = middle + sqrt(max(root, 0.0));
  if (root < 0.0 || far <= 0.0) return 1e9;
  float r = min(far / square, 1.0);
  float slope = sqrt(1.0 - r * r) / r;
  return slope * pixel.worldPerHeight / (texelsPerHeight * light.worldPerTexel);
}
