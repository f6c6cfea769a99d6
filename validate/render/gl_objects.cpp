#include "render/gl_objects.h"

namespace gnomon::render::gl {
namespace {

GLint targetOf(const Texture& texture) {
  GLint target = 0;
  glGetTextureParameteriv(texture.name(), GL_TEXTURE_TARGET, &target);
  return target;
}

}  // namespace

int limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

Buffer makeBuffer(std::span<const std::byte> bytes) {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), 0);
  return Buffer(name);
}

VertexArray makeVertexArray(const Buffer& vertices, std::size_t stride,
                            std::span<const Attribute> attributes) {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  glVertexArrayVertexBuffer(name, 0, vertices.name(), 0, static_cast<GLsizei>(stride));
  for (const auto& [location, components, offset, type] : attributes) {
    const auto place = static_cast<GLuint>(offset);
    glEnableVertexArrayAttrib(name, location);
    if (type == GL_INT) {
      glVertexArrayAttribIFormat(name, location, components, type, place);
    } else {
      glVertexArrayAttribFormat(name, location, components, type, GL_FALSE, place);
    }
    glVertexArrayAttribBinding(name, location, 0);
  }
  return VertexArray(name);
}

Texture makeTexture(GLenum target, GLenum format, TextureSize size, GLint filter) {
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  if (target == GL_TEXTURE_2D) {
    glTextureStorage2D(name, size.levels, format, size.width, size.height);
  } else {
    glTextureStorage3D(name, size.levels, format, size.width, size.height, size.layers);
  }
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return Texture(name);
}

void fill(const Texture& texture, TextureSize size, GLenum format, GLenum type, const void* texels,
          int level) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (targetOf(texture) == GL_TEXTURE_2D) {
    glTextureSubImage2D(texture.name(), level, 0, 0, size.width, size.height, format, type, texels);
  } else {
    glTextureSubImage3D(texture.name(), level, 0, 0, 0, size.width, size.height, size.layers,
                        format, type, texels);
  }
}

}  // namespace gnomon::render::gl
