// The ends of lines in the world.

layout(location = 0) in vec3 vertexPosition;

uniform mat4 clipFromWorld;

void main() {
  gl_Position = clipFromWorld * vec4(vertexPosition, 1.0);
}
