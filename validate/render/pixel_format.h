#pragma once

#include <array>

#include "horizon/stored_table.h"
#include "relief/height_field.h"
#include "render/gl_handles.h"

namespace gnomon::render {

/// How textures keep the values of tables.
struct PixelFormat {
  std::array<GLenum, 4> sized;  ///< internal formats of 1 to 4 channels
  GLenum type;                  ///< of a value in main memory
  double steps;                 ///< 2^bits - 1; 0 for floats
};

PixelFormat pixelFormat(horizon::TableBits bits);

/// The format of 1 to 4 channels in main memory.
constexpr std::array<GLenum, 4> channelFormats = {GL_RED, GL_RG, GL_RGB, GL_RGBA};

/// Makes a texture go on as a map does; past a border the outermost entries hold.
void setWrap(GLuint texture, relief::Wrap wrap, relief::Border border = {});

}  // namespace gnomon::render
