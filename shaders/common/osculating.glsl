// Horizons on the circle that the surface follows in the light's direction: normal curvature κ
// (1 / world, convex positive), lengths in the world.

// The bare surface's horizon from a height over it, eq. (3) of Onoue, Max & Nishita 2004:
// tan β′ = -√(1 - c²) / c with c = 1 / (κh + 1), that is -√(κh (κh + 2)). Only for κ > 0: on a
// concave surface it has no meaning. Below the bare surface h counts as 0.
float bareHorizon(float curvature, float height) {
  float rise = curvature * max(height, 0.0);
  return -sqrt(rise * (rise + 2.0));
}

// The slope at which an occluder is seen from height h₀ that stands at arc length t and, on the flat
// relief, at the slope (h₁ - h₀) / t: with γ = κt,
//   tan β′ = (cos γ - (1 + κh₀) / (1 + κh₁)) / sin γ
//          = (slope · t κ / (1 + κh₁) - 2 sin²(γ/2)) / sin γ,
// the second form without the difference of two numbers near 1. It tends to the slope itself as κ → 0,
// and, for an attached horizon (t = 0), to slope / (1 + κh₀).
float osculatingHorizon(float curvature, float height, float slope, float arcLength) {
  float angle = curvature * arcLength;
  // A quarter turn on, the circle has nothing more to do with the surface: a convex one lies behind its
  // own horizon, and in a bowl the circle would close over one's head.
  if (abs(angle) > 0.5 * pi) return -1e9;
  // 1 + κh₁, above 0: a bump in a bowl does not reach the circle's centre.
  float peak = max(1.0 + curvature * (height + slope * arcLength), 1e-3);
  if (abs(angle) < 1e-4) return slope / peak - 0.5 * angle;
  float sineOfHalf = sin(0.5 * angle);
  return (slope * angle / peak - 2.0 * sineOfHalf * sineOfHalf) / sin(angle);
}

// Where a ray at a slope from height h₀ is above all that a relief up to height H has: from the first
// arc length on, up to the second, in a bowl, where the circle rises to it again. With P = 1 + κH,
// p = 1 + κh₀ and a = κ × the way along the tangent, it meets the circle of height H where
//   (1 + slope²) a² + 2 slope p a + p² - P² = 0;
// each root is written without a difference. 1e30 where it never does.
vec2 aboveRelief(float curvature, float height, float slope, float highest) {
  float own = 1.0 + curvature * height;
  float top = 1.0 + curvature * highest;
  float squared = 1.0 + slope * slope;
  float root = squared * top * top - own * own;
  // It stays below them, or they come near the circle's centre.
  if (root < 0.0 || top < 1e-2 || (slope <= 0.0 && curvature < 1e-9)) return vec2(1e30);
  float far = abs(slope * own) + sqrt(root);
  vec2 along = slope > 0.0 ? vec2((highest - height) * (own + top) / far, 1e30)
                           : vec2(far / (squared * curvature), 1e30);
  if (curvature < -1e-9) along.y = -far / (squared * curvature);
  vec2 up = own + slope * curvature * along;
  vec2 turns = curvature * along / up;
  vec2 arcs = mix(atan(turns) / curvature, along / up, lessThan(abs(turns), vec2(1e-4)));
  return mix(vec2(1e30), arcs, bvec2(up.x > 0.0, up.y > 0.0 && curvature < -1e-9));
}
