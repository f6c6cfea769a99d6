// Covers the whole target by one triangle. There is no surface: what pixels would know of it is no
// number, and shows where something depends on it.

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec3 px;
layout(location = 3) out vec3 py;
layout(location = 4) out vec3 v1;
layout(location = 5) out vec3 v2;
layout(location = 6) out vec2 curvatures;
layout(location = 7) out vec2 texel;
layout(location = 8) flat out int face;
layout(location = 9) out vec2 st;
layout(location = 10) out vec4 vertexLight;
layout(location = 11) flat out int chart;
#ifdef ON_POLYGONS
layout(location = 12) out vec3 columnDirection;
#endif

void main() {
  float nothing = uintBitsToFloat(0x7fc00000u);
  position = normal = px = py = v1 = v2 = vec3(nothing);
  curvatures = texel = st = vec2(nothing);
  face = -1;
  chart = 0;
  vertexLight = vec4(nothing);
#ifdef ON_POLYGONS
  columnDirection = vec3(nothing);
#endif
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
