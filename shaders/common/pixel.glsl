// What a pixel knows of the surface it shows, and the light as horizon methods see it from there.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 px;
layout(location = 3) in vec3 py;
layout(location = 4) in vec3 v1;
layout(location = 5) in vec3 v2;
layout(location = 6) in vec2 curvatures;
layout(location = 7) in vec2 texel;
layout(location = 8) flat in int face;
layout(location = 9) in vec2 st;
layout(location = 10) in vec4 vertexLight;  // interpolated: see surface.vert
layout(location = 11) flat in int chart;    // of the texture, from 1; 0 where there is no surface

uniform vec3 lightDirection;      // L: unit vector toward the light, world
uniform bool heightInTexels;      // else in world units
uniform float texelsPerHeight;    // of the frame in which tables hold angles

const float pi = 3.14159265358979;

struct Pixel {
  vec3 position;         // world
  vec3 normal;           // n: unit, outward
  vec3 px, py;           // P_x, P_y: world length per texel
  vec3 v1, v2;           // principal directions, interpolated: neither unit nor orthogonal
  float k1, k2;          // principal curvatures, 1 / world, convex positive
  vec2 texel;            // (x, y), texels
  float worldPerHeight;  // a: world length per height unit
};

struct LocalLight {
  vec2 direction;       // e: unit vector of the light's azimuth in the texture plane
  float azimuth;        // φ = atan(e_y, e_x), 0 to 2π
  float worldPerTexel;  // σ = |e_x P_x + e_y P_y|
  float slope;          // tan θ = (L·n) / |L - (L·n) n|
  vec3 tangent;         // V = L - (L·n) n, world
};

Pixel makePixel() {
  Pixel pixel;
  pixel.position = position;
  pixel.normal = normalize(normal);
  pixel.px = px;
  pixel.py = py;
  pixel.v1 = v1;
  pixel.v2 = v2;
  pixel.k1 = curvatures.x;
  pixel.k2 = curvatures.y;
  pixel.texel = texel;
  // Max's third axis N / |N|^½ (Max 1988) makes a height of one texel as long as a texel is wide.
  pixel.worldPerHeight = heightInTexels ? sqrt(length(cross(px, py))) : 1.0;
  return pixel;
}

// L = ℓ_x P_x + ℓ_y P_y + c n by the dual basis: P_x and P_y need be neither orthogonal nor equally
// long (Max 1988; the inverted frame of Sloan & Cohen 2000, §2).
LocalLight makeLocalLight(Pixel pixel, vec3 light) {
  float volume = dot(pixel.px, cross(pixel.py, pixel.normal));
  vec2 local = vec2(dot(light, cross(pixel.py, pixel.normal)),
                    dot(light, cross(pixel.normal, pixel.px))) / volume;
  LocalLight result;
  float size = length(local);
  result.direction = size > 0.0 ? local / size : vec2(1.0, 0.0);
  float azimuth = atan(result.direction.y, result.direction.x);
  result.azimuth = azimuth < 0.0 ? azimuth + 2.0 * pi : azimuth;
  result.worldPerTexel = length(result.direction.x * pixel.px + result.direction.y * pixel.py);
  float elevation = dot(light, pixel.normal);
  result.tangent = light - elevation * pixel.normal;
  result.slope = elevation / max(length(result.tangent), 1e-20);
  return result;
}

// κ in the light's direction from the interpolated principal directions: eq. (1) of Onoue, Max &
// Nishita 2004, κ = κ₁ cos²φ + κ₂ sin²φ, both squares from dot products and without a square root.
float normalCurvature(Pixel pixel, vec3 direction) {
  float along1 = dot(direction, pixel.v1);
  float along2 = dot(direction, pixel.v2);
  float square = max(dot(direction, direction), 1e-30);
  float cosine2 = along1 * along1 / (square * max(dot(pixel.v1, pixel.v1), 1e-30));
  float sine2 = along2 * along2 / (square * max(dot(pixel.v2, pixel.v2), 1e-30));
  return pixel.k1 * cosine2 + pixel.k2 * sine2;
}

#ifdef MESH_DISPLACED

// The drawn triangle's own normal, outward. A triangle is flat: differences of its position are exact.
vec3 facetNormal(Pixel pixel) {
  vec3 facet = cross(dFdx(position), dFdy(position));
  return normalize(dot(facet, pixel.normal) < 0.0 ? -facet : facet);
}

#endif
