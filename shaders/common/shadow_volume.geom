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

struct Corner {
  vec3 world;
  vec4 clip;
};

// The wall at the side from a to b of a triangle a, b, third.
void emitWall(bool lit, Corner a, Corner b, vec3 third, vec3 beyond) {
  bool alone = beyond == third;  // the mesh's border
  if (!alone && facesLight(b.world, a.world, beyond) == lit) return;
  emitTriangle(lit ? a.clip : b.clip, clipOfInfinity, lit ? b.clip : a.clip);
}

// All indices of inputs are constants: where one differs between the triangles that it draws at once,
// as in gl_in[lit ? 2 : 4], llvmpipe of Mesa 25.0 takes vertices of other triangles.
void main() {
  Corner a = Corner(world[0], gl_in[0].gl_Position);
  Corner b = Corner(world[2], gl_in[2].gl_Position);
  Corner c = Corner(world[4], gl_in[4].gl_Position);
  bool lit = facesLight(a.world, b.world, c.world);
  emitTriangle(a.clip, lit ? b.clip : c.clip, lit ? c.clip : b.clip);
  emitWall(lit, a, b, c.world, world[1]);
  emitWall(lit, b, c, a.world, world[3]);
  emitWall(lit, c, a, b.world, world[5]);
}
