#include "render/gl_objects.h"

#include <fmt/core.h>

#include "common/error.h"

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

namespace gnomon::render {

namespace {

void requireSize(int width, int height) {
  const int largest = gl::limit(GL_MAX_TEXTURE_SIZE);
  if (width > largest || height > largest) {
    throw InputError(fmt::format("view: {} × {} samples, OpenGL takes at most {} a side", width,
                                 height, largest));
  }
}

int levelsOf(int width, int height) {
  int levels = 1;
  for (int side = std::max(width, height); side > 1; side /= 2) ++levels;
  return levels;
}

}  // namespace

Target::Target(int width, int height, const std::vector<GLenum>& formats, Stencil stencil,
               Reading reading)
    : width_(width), height_(height), stencil_(stencil), reading_(reading) {
  requireSize(width, height);
  framebuffer_ = gl::makeFramebuffer();
  std::vector<GLenum> attachments;
  for (const GLenum format : formats) {
    const int levels = reading == Reading::mips ? levelsOf(width, height) : 1;
    colours_.push_back(gl::makeTexture(GL_TEXTURE_2D, format, {width, height, 1, levels},
                                       reading == Reading::texels ? GL_NEAREST : GL_LINEAR));
    if (reading == Reading::mips) {
      glTextureParameteri(colours_.back().name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    }
    attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
    glNamedFramebufferTexture(framebuffer_.name(), attachments.back(), colours_.back().name(), 0);
  }
  const bool counts = stencil == Stencil::eightBits;
  depth_ = gl::makeTexture(GL_TEXTURE_2D, counts ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F,
                           {width, height}, GL_NEAREST);
  if (counts) {
    glTextureParameteri(depth_.name(), GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
  }
  glNamedFramebufferTexture(framebuffer_.name(),
                            counts ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                            depth_.name(), 0);
  glNamedFramebufferDrawBuffers(framebuffer_.name(), static_cast<GLsizei>(attachments.size()),
                                attachments.data());
  if (glCheckNamedFramebufferStatus(framebuffer_.name(), GL_DRAW_FRAMEBUFFER) !=
      GL_FRAMEBUFFER_COMPLETE) {
    throw InternalError(fmt::format("no framebuffer of {} × {} pixels", width, height));
  }
  clearDepth();  // so that the first frame's time is not that of getting the memory
}

void Target::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
}

void Target::makeMips() const {
  if (reading_ != Reading::mips) return;
  for (const gl::Texture& colour : colours_) glGenerateTextureMipmap(colour.name());
}

void Target::clearDepth() const {
  const GLfloat farthest = 1;
  if (stencil_ == Stencil::eightBits) {
    glClearNamedFramebufferfi(framebuffer_.name(), GL_DEPTH_STENCIL, 0, farthest, 0);
  } else {
    glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &farthest);
  }
}

void Target::readUpward(std::size_t attachment, GLenum format, GLenum type, std::size_t bytes,
                        void* values) const {
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(colourTexture(attachment), 0, format, type, static_cast<GLsizei>(bytes),
                    values);
}

const Target& SharedTargets::get(int width, int height, const std::vector<GLenum>& formats) const {
  if (width != width_ || height != height_) targets_.clear();
  width_ = width;
  height_ = height;
  return targets_.try_emplace(formats, width, height, formats).first->second;
}

PixelFormat pixelFormat(horizon::TableBits bits) {
  if (bits == horizon::TableBits::eight) {
    return {{GL_R8, GL_RG8, GL_RGB8, GL_RGBA8}, GL_UNSIGNED_BYTE, 255};
  }
  if (bits == horizon::TableBits::sixteen) {
    return {{GL_R16, GL_RG16, GL_RGB16, GL_RGBA16}, GL_UNSIGNED_SHORT, 65535};
  }
  return {{GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F}, GL_FLOAT, 0};
}

void setWrap(GLuint texture, relief::Wrap wrap, relief::Border border) {
  const auto mode = [wrap](bool clamped) {
    return wrap == relief::Wrap::repeat && !clamped ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  };
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, mode(border.x));
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, mode(border.y));
}

}  // namespace gnomon::render
