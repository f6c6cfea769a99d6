// One triangle's part of the shadow volume's surface, seen counter-clockwise from outside: the cap,
// turned to the light, and a triangle to infinity at each side where the volume ends.

layout(triangles_adjacency) in;
layout(triangle_strip, max_vertices = 12) out;

in vec3 world[];

uniform vec3 lightDirection;
uniform vec4 clipOfInfinity;  // the point at infinity away from the light, in clip space

invariant gl_Position;

bool isBefore(vec3 a, vec3 b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

// Both triangles at a side must come to the same answer about each other, whatever corner they begin
// at: rounding in another order would leave the volume open.
bool facesLight(vec3 a, vec3 b, vec3 c) {
  vec3 p = a, q = b, r = c;
  if (isBefore(b, a) && isBefore(b, c)) {
    p = b; q = c; r = a;
  } else if (isBefore(c, a) && isBefore(c, b)) {
    p = c; q = a; r = b;
  }
  return dot(cross(q - p, r - p), lightDirection) > 0.0;
}

void emitTriangle(vec4 a, vec4 b, vec4 c) {
  gl_Position = a;
  EmitVertex();
  gl_Position = b;
  EmitVertex();
  gl_Position = c;
  EmitVertex();
  EndPrimitive();
}

void main() {
  bool lit = facesLight(world[0], world[2], world[4]);
  emitTriangle(gl_in[0].gl_Position, gl_in[lit ? 2 : 4].gl_Position, gl_in[lit ? 4 : 2].gl_Position);
  for (int a = 0; a < 6; a += 2) {
    int b = (a + 2) % 6;
    int third = (a + 4) % 6;
    int beyond = a + 1;
    bool alone = world[beyond] == world[third];  // the mesh's border
    if (!alone && facesLight(world[b], world[a], world[beyond]) == lit) continue;
    emitTriangle(gl_in[lit ? a : b].gl_Position, clipOfInfinity, gl_in[lit ? b : a].gl_Position);
  }
}
