// The picture of a mask or of shares of light: diffuse light by the shading normal, as much as
// there is light, ambient light everywhere. The pictures of the base mesh are all shaded by N', so
// that they differ by their masks alone, whatever normal a method's mask was made by.

uniform sampler2D litShares;  // 0 to 1

layout(location = 0) out vec4 colour;

const vec3 albedo = vec3(0.86, 0.80, 0.72);
const float ambient = 0.16;
// A lit point is never as dark as a shadowed one: the truth lights points, too, that are turned from
// the light by their bumped normal.
const float leastCosine = 0.02;

void main() {
  Pixel pixel = makePixel();
  float cosine = max(dot(shadingNormal(pixel), lightDirection), leastCosine);
  float share = texelFetch(litShares, ivec2(gl_FragCoord.xy), 0).r;
  vec3 light = albedo * (ambient + share * ((1.0 - ambient) * cosine));
  colour = vec4(pow(light, vec3(1.0 / 2.2)), 1.0);
}
