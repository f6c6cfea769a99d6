// A bake or a pass of the method's own: what a function of the method makes of one texel. `main` is
// written for the declaration.

layout(location = 0) out vec4 stored;

uniform int bakeNumber;   // of the function, in the order of the declaration
uniform int bakeLayer;
uniform vec2 bakeStep;    // texels of the map per texel of the bake
uniform vec2 bakeCorner;  // texel of the bake at the target's corner

vec4 widened(float value) { return vec4(value, 0.0, 0.0, 0.0); }
vec4 widened(vec2 value) { return vec4(value, 0.0, 0.0); }
vec4 widened(vec3 value) { return vec4(value, 0.0); }
vec4 widened(vec4 value) { return value; }
