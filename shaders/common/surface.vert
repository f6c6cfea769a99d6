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
layout(location = 10) in int vertexChart;

#ifdef ON_POLYGONS
layout(location = 11) in vec3 vertexDirection;
layout(location = 12) out vec3 columnDirection;
#endif

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

uniform mat4 clipFromWorld;
// Columns and rows of face tiles where the view is an atlas; zero where it is a camera's.
uniform ivec2 atlasTiles;
// Corner and size in texels where the view is the texture's own plane; zero elsewhere.
uniform vec4 texelWindow;
uniform vec3 lightDirection;
uniform bool heightInTexels;
uniform float texelsPerHeight;

invariant gl_Position;

// The light as a program for each vertex hands it on, to be interpolated: its part along P_x and P_y
// (by the inverted frame of Sloan & Cohen 2000, §4.1), as long as in the world where the frame is
// even; the cosine of its angle off the normal, in the world and in the frame of angles, where texels
// are squares and a height unit is texelsPerHeight of them high.
vec4 lightAtVertex() {
  vec3 normal = vertexNormal;
  float volume = dot(vertexPx, cross(vertexPy, normal));
  float cosine = dot(lightDirection, normal);
  // A degenerate vertex has no frame, but pixels between it and others have one: it must not be NaN.
  if (volume == 0.0) return vec4(0.0, 0.0, cosine, cosine);
  vec2 local = vec2(dot(lightDirection, cross(vertexPy, normal)),
                    dot(lightDirection, cross(normal, vertexPx))) / volume;
  float texel = sqrt(length(cross(vertexPx, vertexPy)));
  float rise = texelsPerHeight * cosine / (heightInTexels ? texel : 1.0);
  return vec4(texel * local, cosine, rise / length(vec3(local, rise)));
}

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
  chart = vertexChart;
#ifdef ON_POLYGONS
  columnDirection = vertexDirection;
#endif
  vertexLight = lightAtVertex();
  if (texelWindow.z > 0.0) {
    gl_Position = vec4(2.0 * (vertexTexel - texelWindow.xy) / texelWindow.zw - 1.0, 0.0, 1.0);
  } else if (atlasTiles.x > 0) {
    vec2 tile = vec2(vertexFace % atlasTiles.x, vertexFace / atlasTiles.x);
    gl_Position = vec4(2.0 * (tile + vertexSt) / vec2(atlasTiles) - 1.0, 0.0, 1.0);
  } else {
    gl_Position = clipFromWorld * vec4(vertexPosition, 1.0);
  }
}
