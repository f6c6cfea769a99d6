// The triangle itself.

layout(triangles_adjacency) in;
layout(triangle_strip, max_vertices = 3) out;

invariant gl_Position;

void main() {
  for (int corner = 0; corner < 6; corner += 2) {
    gl_Position = gl_in[corner].gl_Position;
    EmitVertex();
  }
  EndPrimitive();
}
