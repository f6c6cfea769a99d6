// The picture of a mask: diffuse light by the shading normal where the mask is lit, ambient light
// everywhere. The pictures of the base mesh are all shaded by N', so that they differ by their masks
// alone, whatever normal a method's mask was made by.

uniform usampler2D shadowMask;

layout(location = 0) out vec4 colour;

const vec3 albedo = vec3(0.86, 0.80, 0.72);
const float ambient = 0.16;
// A lit point is never as dark as a shadowed one: the truth lights points, too, that are turned from
// the light by their bumped normal.
const float leastCosine = 0.02;

void main() {
  Pixel pixel = makePixel();
  float cosine = max(dot(shadingNormal(pixel), lightDirection), leastCosine);
  bool lit = texelFetch(shadowMask, ivec2(gl_FragCoord.xy), 0).r == 0u;
  vec3 light = albedo * (ambient + (lit ? (1.0 - ambient) * cosine : 0.0));
  colour = vec4(pow(light, vec3(1.0 / 2.2)), 1.0);
}
