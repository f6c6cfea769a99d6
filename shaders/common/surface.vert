// Draws the base mesh into a view and hands every pixel what the papers' vertex programs hand it:
// the interpolated frame of the coarse mesh. The same stage serves every pass, so that all passes of
// a view rasterise the same samples.

layout(location = 0) in vec3 vertexPosition;
layout(location = 1) in vec3 vertexNormal;
layout(location = 2) in vec3 vertexPx;
layout(location = 3) in vec3 vertexPy;
layout(location = 4) in vec3 vertexV1;
layout(location = 5) in vec3 vertexV2;
layout(location = 6) in vec2 vertexCurvatures;
layout(location = 7) in vec2 vertexTexel;
layout(location = 8) in int vertexFace;
layout(location = 9) in vec2 vertexSt;

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

uniform mat4 clipFromWorld;
// Columns and rows of face tiles where the view is an atlas; zero where it is a camera's.
uniform ivec2 atlasTiles;

invariant gl_Position;

void main() {
  position = vertexPosition;
  normal = vertexNormal;
  px = vertexPx;
  py = vertexPy;
  v1 = vertexV1;
  v2 = vertexV2;
  curvatures = vertexCurvatures;
  texel = vertexTexel;
  face = vertexFace;
  st = vertexSt;
  if (atlasTiles.x > 0) {
    vec2 tile = vec2(vertexFace % atlasTiles.x, vertexFace / atlasTiles.x);
    gl_Position = vec4(2.0 * (tile + vertexSt) / vec2(atlasTiles) - 1.0, 0.0, 1.0);
  } else {
    gl_Position = clipFromWorld * vec4(vertexPosition, 1.0);
  }
}
