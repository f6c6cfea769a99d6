// The light as a disc of angular radius ρ, and the share V of it that stands over a straight horizon.

uniform float lightRadius;  // ρ, radians; 0 is a point

// V of a disc whose centre stands x radii over a straight edge: 1 - (acos x - x √(1 - x²)) / π for
// -1 < x < 1. A flat disc's, the limit of small ρ.
float discShare(float x) {
  float within = clamp(x, -1.0, 1.0);
  float chord = sqrt(1.0 - within * within);
  float share = clamp(1.0 - (atan(chord, within) - within * chord) / pi, 0.0, 1.0);
  // Whole and nothing are exact, and what is no number is nothing.
  return x > -1.0 ? (x < 1.0 ? share : 1.0) : 0.0;
}

// θ - β, radians, of the slopes tan θ and tan β: one angle, since near each other two would leave
// little of their difference.
float angleOver(float slope, float horizon) { return atan(slope - horizon, 1.0 + slope * horizon); }

// V where the disc's centre stands at the slope tan θ, over a straight horizon at the slope tan β. Of
// a point it is 0 or 1.
float shareOver(float slope, float horizon) {
  float share = discShare(angleOver(slope, horizon) / max(lightRadius, 1e-20));
  return lightRadius > 0.0 ? share : (slope > horizon ? 1.0 : 0.0);
}

// tan(θ + α) of a slope tan θ and a small angle by its tangent; 1e9 from the vertical on.
float slopeTurned(float slope, float tangent) {
  float along = 1.0 - slope * tangent;
  return along > 1e-9 ? (slope + tangent) / along : 1e9;
}

// The light with its slope that of the lowest ray of the disc, θ - ρ: a march toward it meets all that
// hides some of the disc.
LocalLight lowestRay(LocalLight light) {
  light.slope = slopeTurned(light.slope, -tan(lightRadius));
  return light;
}

// The k-th of n places in the unit disc, which stand for equal areas: on a spiral that turns by the
// golden angle from one to the next (Vogel 1979), each in the middle, by area, of its ring.
vec2 discPlace(int k, int n) {
  float turn = 2.39996323 * float(k);
  return sqrt((float(k) + 0.5) / float(n)) * vec2(cos(turn), sin(turn));
}

// A direction turned by the golden angle: from (1, 0) on, those of discPlace, without a sine in a loop.
vec2 goldenTurn(vec2 direction) {
  return mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888) * direction;
}

// The k-th of n unit vectors toward the light's disc, which stand for equal solid angles: α off the
// centre, sin² α/2 is uniform.
vec3 discDirection(int k, int n) {
  vec2 place = sin(0.5 * lightRadius) * discPlace(k, n);
  float square = dot(place, place);
  vec3 axis = abs(lightDirection.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
  vec3 side = normalize(cross(lightDirection, axis));
  vec3 up = cross(side, lightDirection);
  vec2 across = 2.0 * sqrt(1.0 - square) * place;
  return (1.0 - 2.0 * square) * lightDirection + across.x * side + across.y * up;
}
