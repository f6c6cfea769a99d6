#include "render/pixel_format.h"

namespace gnomon::render {

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
