/* gnomon-method
title = "Screen-space shadows"
citation = "Aldridge 2023 (Bend Studio, Days Gone), as in Godot and Bevy"
family = "displaced"
symbol = "diamond"
passes = ["camera-depth"]
mesh = "displaced"
subdivisions = 9

[parameters.samples]
default = 60
minimum = 12
maximum = 4096
type = "int"
about = "pixels of the picture that are asked on the way to the light"

[parameters.thickness]
default = 0.005
minimum = 1e-6
maximum = 1
about = "how thick what the camera sees is taken to be, share of its distance"

[parameters.edge]
default = 0.02
minimum = 0
maximum = 1
about = "difference of neighbouring depths from which on they are an edge and not interpolated, share of the distance"

[parameters.contrast]
default = 4
minimum = 1
maximum = 100
about = "how soon a sample that is not in the middle of the thickness counts less"
*/

// The depth that the camera sees is marched in its own picture, from the pixel toward the light, a pixel
// from each sample to the next. What stands nearer to the camera than the ray, and by no more than a
// thickness that is taken for all, shades it. What the camera does not see shades nothing, and
// shadows end after so many pixels, however large the picture is.
//
// Read from the studio's published shader, whose numbers are the defaults; samples in its order: the
// first 4 may each shade all, the others are four interleaved rows whose mean counts, and the last 8
// fade out. It is a compute shader, for its speed; the arithmetic is of one pixel. Depth is taken as
// 1 / distance along the view, as a reversed depth buffer of an infinite far plane holds it, whatever
// the planes here are. The share is cut at one half where the light is a point, and a disc's radius
// is not known to it.

const int hardSamples = 4;
const int fadedSamples = 8;

// 1 / distance of a place in the picture. It is linear over the picture along a line.
float nearnessOf(vec3 place) { return (worldFromCameraMap * vec4(place, 1.0)).w; }

// What the camera sees at a pixel; 0, the infinite, beyond the picture and where nothing is.
float nearnessSeen(ivec2 pixel) {
  ivec2 size = textureSize(cameraDepthMap, 0);
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size))) return 0.0;
  float depth = cameraDepthOf(pixel);
  return depth < 1.0 ? nearnessOf(vec3(vec2(pixel) + 0.5, depth)) : 0.0;
}

// What shades from a place on the ray, between two pixels beside each other across it: the farther of
// both and as much again, but of an edge the pixel's own.
float shadingNearness(vec2 at, bool isAlongX) {
  float across = fract(isAlongX ? at.y : at.x) - 0.5;
  int beside = across > 0.0 ? 1 : -1;
  ivec2 pixel = ivec2(floor(at));
  float own = nearnessSeen(pixel);
  float other = nearnessSeen(pixel + (isAlongX ? ivec2(0, beside) : ivec2(beside, 0)));
  float apart = abs(own - other);
  return apart > edge * own ? own : own - apart;
}

float contrasted(float off) { return clamp(off * contrast + 1.0 - contrast, 0.0, 1.0); }

float visibility(Pixel pixel, LocalLight light) {
  vec3 start = vec3(gl_FragCoord.xy, cameraDepthOf(ivec2(gl_FragCoord.xy)));
  vec4 toward = cameraMapFromWorld * vec4(lightDirection, 0.0);
  vec3 way = toward.xyz - toward.w * start;  // in the picture
  float major = max(abs(way.x), abs(way.y));
  bool isAlongX = abs(way.x) > abs(way.y);
  // Pixels to the light's own place in the picture, below 0 where it is behind the camera.
  float ahead = toward.w != 0.0 ? major / toward.w : 1e9;
  way /= max(major, 1e-20);
  float nearness = nearnessOf(start);

  // How far from the middle of the thickness, 1 at both of its ends.
  float hard = 1.0;
  vec4 rows = vec4(1.0);
  for (int i = 1; i <= samples; ++i) {
    float left = 1.0 - float(i) / ahead;  // of the way to the light's place
    if (left <= 0.0) break;
    vec3 at = start + float(i) * way;
    float over = (shadingNearness(at.xy, isAlongX) - nearnessOf(at)) / left;
    float off = abs(over / (thickness * nearness) - 1.0);
    int faded = i - (samples - fadedSamples);
    off += faded > 0 ? 0.75 * float(faded) / float(fadedSamples + 1) : 0.0;
    if (i <= hardSamples) {
      hard = min(hard, off);
    } else {
      rows[(i - 1) & 3] = min(rows[(i - 1) & 3], off);
    }
  }
  float soft = 0.0;
  for (int row = 0; row < 4; ++row) soft += 0.25 * contrasted(rows[row]);
  return min(contrasted(hard), soft);
}
