// The picture of a mask: bump-mapped diffuse light where the mask is lit, ambient light everywhere.

uniform usampler2D shadowMask;

layout(location = 0) out vec4 colour;

const vec3 albedo = vec3(0.86, 0.80, 0.72);
const float ambient = 0.16;

void main() {
  Pixel pixel = makePixel();
  // Central differences over half a texel: continuous, where the bilinear gradient jumps.
  vec2 gradient = vec2(heightAt(pixel.texel + vec2(0.5, 0.0)) - heightAt(pixel.texel - vec2(0.5, 0.0)),
                       heightAt(pixel.texel + vec2(0.0, 0.5)) - heightAt(pixel.texel - vec2(0.0, 0.5)));
  float cosine = max(dot(bumpedNormal(pixel, gradient), lightDirection), 0.0);
  bool lit = texelFetch(shadowMask, ivec2(gl_FragCoord.xy), 0).r == 0u;
  vec3 light = albedo * (ambient + (lit ? (1.0 - ambient) * cosine : 0.0));
  colour = vec4(pow(light, vec3(1.0 / 2.2)), 1.0);
}
