// The texture pass: what the method makes of one texel, and that there is one.

layout(location = 0) out vec2 resolved;

void main() {
  resolved = vec2(resolveTexel(makePixel()), 1.0);
}
