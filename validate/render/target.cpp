#include "render/target.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "render/gl_objects.h"

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

}  // namespace gnomon::render
