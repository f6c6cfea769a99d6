// The limit surface at a pixel: its point, and how its normal turns. The camera draws a coarse mesh,
// which lies below the surface where that is convex.

// P from the drawn triangle. Where corners p_i with normals n_i have the weights w_i, the surface
// stands ½ Σ w_i κ |p_i - p|² above, and the interpolated normal is shorter than 1 by
// ½ Σ w_i |n_i - n|² = ½ Σ w_i κ² |p_i - p|². With corners spread alike along both principal
// directions the quotient is (κ₁ + κ₂) / (κ₁² + κ₂²); on a sphere 1 / κ, exactly of second order.
vec3 surfacePoint(Pixel pixel) {
  float rounding = 4e-7;
  float shorter = max(1.0 - length(normal) - rounding, 0.0);
  float squares = pixel.k1 * pixel.k1 + pixel.k2 * pixel.k2;
  float above = squares > 0.0 ? shorter * (pixel.k1 + pixel.k2) / squares : 0.0;
  return pixel.position + above * pixel.normal;
}

// n_x along a tangent vector of P_x's kind (Weingarten: the normal turns with the curvature).
vec3 turnOfNormal(Pixel pixel, vec3 along) {
  float first = dot(along, pixel.v1) / max(dot(pixel.v1, pixel.v1), 1e-30);
  float second = dot(along, pixel.v2) / max(dot(pixel.v2, pixel.v2), 1e-30);
  return pixel.k1 * first * pixel.v1 + pixel.k2 * second * pixel.v2;
}
