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

Target::Target(int width, int height, const std::vector<GLenum>& formats)
    : width_(width),
      height_(height),
      framebuffer_(gl::makeFramebuffer()),
      depth_(gl::makeTexture(GL_TEXTURE_2D)) {
  requireSize(width, height);
  std::vector<GLenum> attachments;
  for (const GLenum format : formats) {
    colours_.push_back(gl::makeTexture(GL_TEXTURE_2D));
    glTextureStorage2D(colours_.back().name(), 1, format, width, height);
    attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
    glNamedFramebufferTexture(framebuffer_.name(), attachments.back(), colours_.back().name(), 0);
  }
  glTextureStorage2D(depth_.name(), 1, GL_DEPTH_COMPONENT32F, width, height);
  glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  glNamedFramebufferDrawBuffers(framebuffer_.name(), static_cast<GLsizei>(attachments.size()),
                                attachments.data());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw InternalError(fmt::format("no framebuffer of {} × {} pixels", width, height));
  }
}

Target::~Target() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Target::clearDepth() const {
  const GLfloat farthest = 1;
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &farthest);
}

void Target::readUpward(int attachment, GLenum format, GLenum type, void* values) const {
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glNamedFramebufferReadBuffer(framebuffer_.name(),
                               GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
  glReadPixels(0, 0, width_, height_, format, type, values);
}

}  // namespace gnomon
