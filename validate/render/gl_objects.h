#pragma once

#include <cstddef>
#include <span>

#include "render/gl_handles.h"

namespace gnomon::render::gl {

// GL objects made and filled by direct state access: nothing here is bound, so that no draw call
// depends on what was made before it.

/// A limit of the context that is current, as GL_MAX_TEXTURE_SIZE.
int limit(GLenum name);

/// An immutable buffer with these bytes.
Buffer makeBuffer(std::span<const std::byte> bytes);

/// Where a vertex array finds one attribute of a vertex.
struct Attribute {
  GLuint location;  ///< as the vertex stage declares it
  int components;
  std::size_t offset;      ///< bytes from the vertex's begin
  GLenum type = GL_FLOAT;  ///< GL_INT for attributes that stay integers
};

/// A vertex array over one buffer of vertices.
/// @param stride  bytes a vertex
VertexArray makeVertexArray(const Buffer& vertices, std::size_t stride,
                            std::span<const Attribute> attributes);

/// The size of a texture's first level; `layers` counts for three-dimensional targets and arrays.
struct TextureSize {
  int width, height, layers = 1;
  int levels = 1;  ///< of mips, each half as wide and high as the one before, rounded down
};

/// An empty texture, clamped to its edge.
/// @param target  GL_TEXTURE_2D, GL_TEXTURE_3D or GL_TEXTURE_2D_ARRAY
/// @param format  sized internal format
/// @param filter  GL_NEAREST or GL_LINEAR, both ways
Texture makeTexture(GLenum target, GLenum format, TextureSize size, GLint filter);

/// Fills a level of a texture. Rows lie without gaps.
/// @param size          of that level
/// @param format, type  of a texel as it lies in memory
void fill(const Texture& texture, TextureSize size, GLenum format, GLenum type, const void* texels,
          int level = 0);

}  // namespace gnomon::render::gl
