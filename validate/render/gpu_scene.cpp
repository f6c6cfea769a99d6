#include "render/gpu_scene.h"

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <vector>

#include "common/error.h"
#include "render/gl_context.h"

namespace gnomon {
namespace {

/// BaseVertex as the vertex stage reads it (surface.vert).
struct GpuVertex {
  std::array<glm::vec3, 6> vectors;  // position, normal, P_x, P_y, V_1, V_2
  glm::vec2 curvatures;
  glm::vec2 texel;
  std::int32_t face;
  glm::vec2 st;
};

GpuVertex gpuVertex(const BaseVertex& v) {
  return {{glm::vec3(v.position), glm::vec3(v.normal), glm::vec3(v.px), glm::vec3(v.py),
           glm::vec3(v.v1), glm::vec3(v.v2)},
          glm::vec2(v.k1, v.k2),
          glm::vec2(v.texel),
          v.face,
          glm::vec2(v.st)};
}

void describe(GLuint layout, GLuint location, GLint components, std::size_t offset) {
  glEnableVertexArrayAttrib(layout, location);
  glVertexArrayAttribFormat(layout, location, components, GL_FLOAT, GL_FALSE,
                            static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(layout, location, 0);
}

void setWrap(GLuint texture, Wrap wrap) {
  const GLint mode = wrap == Wrap::repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, mode);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, mode);
}

GLint limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

}  // namespace

GpuMesh::GpuMesh(const BaseMesh& mesh)
    : vertices_(gl::makeBuffer()),
      indices_(gl::makeBuffer()),
      layout_(gl::makeVertexArray()),
      triangleCount_(mesh.triangleCount()) {
  std::vector<GpuVertex> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const BaseVertex& vertex : mesh.vertices) vertices.push_back(gpuVertex(vertex));
  glNamedBufferStorage(vertices_.name(),
                       static_cast<GLsizeiptr>(vertices.size() * sizeof(GpuVertex)),
                       vertices.data(), 0);
  glNamedBufferStorage(indices_.name(),
                       static_cast<GLsizeiptr>(mesh.triangles.size() * sizeof(std::uint32_t)),
                       mesh.triangles.data(), 0);
  const GLuint layout = layout_.name();
  glVertexArrayVertexBuffer(layout, 0, vertices_.name(), 0, sizeof(GpuVertex));
  glVertexArrayElementBuffer(layout, indices_.name());
  for (GLuint k = 0; k < 6; ++k) describe(layout, k, 3, k * sizeof(glm::vec3));
  describe(layout, 6, 2, offsetof(GpuVertex, curvatures));
  describe(layout, 7, 2, offsetof(GpuVertex, texel));
  describe(layout, 9, 2, offsetof(GpuVertex, st));
  glEnableVertexArrayAttrib(layout, 8);
  glVertexArrayAttribIFormat(layout, 8, 1, GL_INT, offsetof(GpuVertex, face));
  glVertexArrayAttribBinding(layout, 8, 0);
  throwOnGlError("taking the base mesh");
}

void GpuMesh::draw() const {
  glBindVertexArray(layout_.name());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangleCount_), GL_UNSIGNED_INT, nullptr);
}

GpuHeights::GpuHeights(const HeightField& field)
    : texture_(gl::makeTexture(GL_TEXTURE_2D)),
      byteCount_(field.texels().size() * sizeof(float)),
      bounds_(field.minimum(), field.maximum()) {
  const GLint largest = limit(GL_MAX_TEXTURE_SIZE);
  if (field.width() > largest || field.height() > largest) {
    throw InputError(fmt::format("relief: a height map of {} × {} texels, OpenGL takes at most {}",
                                 field.width(), field.height(), largest));
  }
  glTextureStorage2D(texture_.name(), 1, GL_R32F, field.width(), field.height());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture_.name(), 0, 0, 0, field.width(), field.height(), GL_RED, GL_FLOAT,
                      field.texels().data());
  glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  setWrap(texture_.name(), field.wrap());
  throwOnGlError("taking the height map");
}

GpuTable::GpuTable(const StoredTable& table, int width, int height, int azimuths, Wrap wrap)
    : texture_(gl::makeTexture(GL_TEXTURE_3D)),
      range_(table.low, table.high - table.low),
      byteCount_(table.bytes.size()) {
  const GLint largest = limit(GL_MAX_3D_TEXTURE_SIZE);
  if (width > largest || height > largest || azimuths > largest) {
    throw InputError(
        fmt::format("bake: tables of {} × {} texels × {} azimuths, OpenGL takes at most {} a side",
                    width, height, azimuths, largest));
  }
  GLenum internal = GL_R8;
  GLenum type = GL_UNSIGNED_BYTE;
  if (table.bits == TableBits::sixteen) {
    internal = GL_R16;
    type = GL_UNSIGNED_SHORT;
  } else if (table.bits == TableBits::thirtyTwo) {
    internal = GL_R32F;
    type = GL_FLOAT;
    range_ = {0, 1};
  }
  glTextureStorage3D(texture_.name(), 1, internal, width, height, azimuths);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage3D(texture_.name(), 0, 0, 0, 0, width, height, azimuths, GL_RED, type,
                      table.bytes.data());
  glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  setWrap(texture_.name(), wrap);
  glTextureParameteri(texture_.name(), GL_TEXTURE_WRAP_R, GL_REPEAT);
  throwOnGlError("taking a horizon table");
}

}  // namespace gnomon
