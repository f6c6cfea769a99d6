// The triangle itself.

layout(triangles_adjacency) in;
layout(triangle_strip, max_vertices = 3) out;

invariant gl_Position;

void emitCorner(vec4 clip) {
  gl_Position = clip;
  EmitVertex();
}

// Indices of inputs are constants, as in shadow_volume.geom.
void main() {
  emitCorner(gl_in[0].gl_Position);
  emitCorner(gl_in[2].gl_Position);
  emitCorner(gl_in[4].gl_Position);
  EndPrimitive();
}
