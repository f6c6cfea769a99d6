/* gnomon-method
title = "Shadow map of the undisplaced mesh, and the relief marched"
citation = "as games with parallax mapping do"
family = "displaced"
symbol = "triangle"
passes = ["light-depth"]

[parameters.depth_side]
default = 2048
minimum = 16
maximum = 8192
about = "texels a side of the depth map, which holds the whole surface"

[parameters.width]
default = 3
minimum = 0
maximum = 64
about = "side of the filter, texels of the depth map; 0 samples one point"

[parameters.bias]
default = 1
minimum = 0
maximum = 64
about = "what a sample must be nearer to the light by, texels of the depth map on a facet that faces it"

[parameters.samples]
default = 16
minimum = 1
maximum = 1024
about = "samples of the filter, and, under a disc, of the search for blockers"
*/

// What a game has today: the depth of the mesh as it is drawn, without its relief, from the light, and
// the height map marched as relief-march does. The depth map knows the body and no bump, the march the
// bumps and a flat surface. Where either is dark the point is.
//
// A sample is compared with the plane of the pixel's own triangle, so that a flat facet never shades
// itself, on whatever side of it the light is: the march sees to that. Under a disc the depth map's
// share is that of percentage-closer soft shadows (Fernando 2005), as shadow-map's, and the smaller
// of the two shares is the answer.

#include "parts/even_march.glsl"

struct Receiver {
  vec3 place;  // in the depth map, the bias taken off
  vec2 tilt;   // of the triangle's plane
};

// Calls derivatives: before any branch.
Receiver makeReceiver(Pixel pixel) {
  vec3 facet = normalize(cross(dFdx(position), dFdy(position)));
  float cosine = dot(facet, lightDirection);
  facet *= cosine < 0.0 ? -1.0 : 1.0;
  cosine = max(abs(cosine), 1e-2);
  float slope = min(sqrt(max(1.0 - cosine * cosine, 0.0)) / cosine, 16.0);
  Receiver receiver;
  receiver.place = lightMapPlace(pixel.position);
  receiver.place.z -= lightMapLengths.x * bias * (1.0 + 0.5 * slope) / lightMapLengths.y;
  receiver.tilt = lightMapTilt(facet, cosine);
  return receiver;
}

// Number and summed depth of what is nearer to the light among samples on a spiral, `across` texels
// wide.
vec2 nearerWithin(Receiver receiver, float across) {
  vec2 sum = vec2(0.0);
  for (int k = 0; k < int(samples); ++k) {
    vec2 at = floor(receiver.place.xy + 0.5 * across * discPlace(k, int(samples)));
    float depth = lightDepthOf(ivec2(at));
    float plane = receiver.place.z + dot(receiver.tilt, at + 0.5 - receiver.place.xy);
    sum += depth < plane ? vec2(1.0, depth) : vec2(0.0);
  }
  return sum;
}

bool isShadowed(Pixel pixel, LocalLight light) {
  float nearer = nearerWithin(makeReceiver(pixel), width).x;
  return nearer > 0.5 * floor(samples) || shadowedOnTheWay(pixel, light);
}

// The share of the disc that the depth map leaves.
float shareByDepth(Pixel pixel) {
  Receiver receiver = makeReceiver(pixel);
  float widest = 2.0 * tan(lightRadius) * lightMapLengths.y / lightMapLengths.x;  // texels, of depth 1
  vec2 blockers = nearerWithin(receiver, max(widest * receiver.place.z, 1.0));
  float depth = blockers.y / max(blockers.x, 1.0);
  float penumbra = max(widest * (receiver.place.z - depth), 1.0);
  float hidden = nearerWithin(receiver, penumbra).x / floor(samples);
  return blockers.x > 0.0 ? 1.0 - hidden : 1.0;
}

float visibility(Pixel pixel, LocalLight light) {
  return min(shareByDepth(pixel), shareOnTheWay(pixel, light));
}
