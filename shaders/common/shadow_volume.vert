// A displaced mesh's vertex, for its depth and for its shadow volumes alike.

layout(location = 0) in vec3 vertexPosition;

out vec3 world;

uniform mat4 clipFromWorld;

invariant gl_Position;

void main() {
  world = vertexPosition;
  gl_Position = clipFromWorld * vec4(vertexPosition, 1.0);
}
