#include "render/target.h"

#include <fmt/core.h>

#include "common/error.h"

namespace gnomon {
namespace {

void requireSize(int width, int height) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width > largest || height > largest) {
    throw InputError(fmt::format("view: {} × {} samples, OpenGL takes at most {} a side", width,
                                 height, largest));
  }
}

}  // namespace

Target::Target(int width, int height, const std::vector<GLenum>& formats, Stencil stencil)
    : width_(width),
      height_(height),
      stencil_(stencil),
      framebuffer_(gl::makeFramebuffer()),
      depth_(gl::makeTexture(GL_TEXTURE_2D)) {
  requireSize(width, height);
  std::vector<GLenum> attachments;
  for (const GLenum format : formats) {
    colours_.push_back(gl::makeTexture(GL_TEXTURE_2D));
    glTextureStorage2D(colours_.back().name(), 1, format, width, height);
    attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
    glTextureParameteri(colours_.back().name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(colours_.back().name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glNamedFramebufferTexture(framebuffer_.name(), attachments.back(), colours_.back().name(), 0);
  }
  const bool counts = stencil == Stencil::eightBits;
  glTextureStorage2D(depth_.name(), 1, counts ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F, width,
                     height);
  if (counts) {
    glTextureParameteri(depth_.name(), GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
  }
  glTextureParameteri(depth_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(depth_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glNamedFramebufferTexture(framebuffer_.name(),
                            counts ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                            depth_.name(), 0);
  glNamedFramebufferDrawBuffers(framebuffer_.name(), static_cast<GLsizei>(attachments.size()),
                                attachments.data());
  bind();
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw InternalError(fmt::format("no framebuffer of {} × {} pixels", width, height));
  }
}

Target::~Target() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Target::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
}

void Target::clearDepth() const {
  const GLfloat farthest = 1;
  if (stencil_ == Stencil::eightBits) {
    glClearNamedFramebufferfi(framebuffer_.name(), GL_DEPTH_STENCIL, 0, farthest, 0);
  } else {
    glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &farthest);
  }
}

void Target::readUpward(int attachment, GLenum format, GLenum type, void* values) const {
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glNamedFramebufferReadBuffer(framebuffer_.name(),
                               GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
  glReadPixels(0, 0, width_, height_, format, type, values);
}

}  // namespace gnomon
