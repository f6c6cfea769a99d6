/* gnomon-method
title = "Relief mapping over a quadric"
citation = "Oliveira & Policarpo 2005"
family = "march"
symbol = "triangle"
tables = ["height"]

[parameters.steps]
default = 64
minimum = 1
maximum = 4096
about = "samples of the height map on the way to the light"
*/

// The surface around a pixel is the quadric z = -(a x² + b y²) along the two axes of its texture,
// of which a and b are stored. Over it a ray toward (l_x, l_y, l_z) climbs, while it goes straight
// over the map, by
//   z(t) = l_z t + (a l_x² + b l_y²) t².
// It is what relief-march does, with a parabola in place of the straight ray. What a quadric without
// a term x y leaves out is the surface's twist between the two axes; heights are measured along z.
//
// The report's abstract and programs that follow it could be read, not its text. It fits a and b at
// every vertex by least squares and interpolates them; here they are half of the exact curvatures
// along P_x and P_y, from the interpolated principal curvatures. The ray ends, as in those programs,
// where it leaves the relief's top: that it may come back in a bowl is left out. They have 40 or 64
// steps.

bool isShadowed(Pixel pixel, LocalLight light) {
  vec2 sides = vec2(length(pixel.px), length(pixel.py)) * light.direction;  // of one texel along e, world
  vec2 quadric = 0.5 * vec2(normalCurvature(pixel, pixel.px), normalCurvature(pixel, pixel.py));
  float height = heightAt(pixel.texel);
  // In height units: the ray's rise per texel, and its bend per texel².
  float rise = light.slope * light.worldPerTexel / pixel.worldPerHeight;
  float bend = dot(quadric, sides * sides) / pixel.worldPerHeight;

  // Where rise t + bend t² is the height of the relief's top over the point.
  float room = heightBounds.y - height;
  float square = rise * rise + 4.0 * bend * room;
  float root = rise + sqrt(max(square, 0.0));
  bool leaves = square >= 0.0 && root > 0.0;
  float end = min(searchRadius, knownDistance(pixel.texel, light.direction));
  if (leaves) end = min(end, 2.0 * room / root);
  for (float i = 1.0; i <= steps; i += 1.0) {
    float t = end * i / steps;
    if (heightAt(pixel.texel + t * light.direction) > height + t * (rise + bend * t)) return true;
  }
  return false;
}
