#pragma once

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "horizon/stored_table.h"
#include "relief/height_field.h"

namespace gnomon::render::gl {

/// Owns one GL object name and deletes it with the context still current.
template <typename Deleter>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (name_ != 0) Deleter{}(name_);
  }

  [[nodiscard]] GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

struct DeleteTexture {
  void operator()(GLuint name) const { glDeleteTextures(1, &name); }
};
struct DeleteBuffer {
  void operator()(GLuint name) const { glDeleteBuffers(1, &name); }
};
struct DeleteVertexArray {
  void operator()(GLuint name) const { glDeleteVertexArrays(1, &name); }
};
struct DeleteFramebuffer {
  void operator()(GLuint name) const { glDeleteFramebuffers(1, &name); }
};
struct DeleteShader {
  void operator()(GLuint name) const { glDeleteShader(name); }
};
struct DeleteQuery {
  void operator()(GLuint name) const { glDeleteQueries(1, &name); }
};
struct DeleteProgram {
  void operator()(GLuint name) const { glDeleteProgram(name); }
};

using Texture = Handle<DeleteTexture>;
using Buffer = Handle<DeleteBuffer>;
using VertexArray = Handle<DeleteVertexArray>;
using Framebuffer = Handle<DeleteFramebuffer>;
using Query = Handle<DeleteQuery>;
using Shader = Handle<DeleteShader>;
using Program = Handle<DeleteProgram>;

inline Query makeTimeQuery() {
  GLuint name = 0;
  glCreateQueries(GL_TIME_ELAPSED, 1, &name);
  return Query(name);
}
inline Framebuffer makeFramebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return Framebuffer(name);
}

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

namespace gnomon::render {

/// A framebuffer of textures of one size, with 32-bit depth and, where asked for, a stencil. To
/// make one binds nothing: a pass binds the target that it draws into (beginPass).
class Target {
 public:
  enum class Stencil { none, eightBits };
  /// How shaders read the colours: texel by texel, or between texels and levels by the GPU's
  /// filter.
  enum class Reading { texels, filtered, mips };

  /// @param formats  sized internal formats of the colour attachments, in order; may be empty
  /// @throws InputError if a side is larger than GL's largest texture
  Target(int width, int height, const std::vector<GLenum>& formats, Stencil stencil = Stencil::none,
         Reading reading = Reading::texels);

  [[nodiscard]] GLuint framebuffer() const { return framebuffer_.name(); }

  /// Makes the following draws go here.
  void bind() const;
  /// Sets all depths to the farthest, and the stencil, if any, to 0.
  void clearDepth() const;
  /// Fills the coarser levels of colours that have any.
  void makeMips() const;
  [[nodiscard]] GLuint colourTexture(std::size_t attachment) const {
    return colours_[attachment].name();
  }
  /// Read in a shader it gives the depth or, with a stencil, the stencil's count.
  [[nodiscard]] GLuint depthTexture() const { return depth_.name(); }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// The content of one attachment, row 0 at the top (GL's own row 0 is the bottom).
  /// @param components  values of type Value that a pixel has in this format and type
  template <typename Value>
  [[nodiscard]] std::vector<Value> read(std::size_t attachment, GLenum format, GLenum type,
                                        int components) const {
    const std::size_t stride =
        static_cast<std::size_t>(width_) * static_cast<std::size_t>(components);
    std::vector<Value> values(stride * static_cast<std::size_t>(height_));
    readUpward(attachment, format, type, values.size() * sizeof(Value), values.data());
    for (auto top = values.begin(), bottom = values.end(); bottom - top > std::ptrdiff_t(stride);) {
      bottom -= static_cast<std::ptrdiff_t>(stride);
      std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(stride), bottom);
      top += static_cast<std::ptrdiff_t>(stride);
    }
    return values;
  }

 private:
  void readUpward(std::size_t attachment, GLenum format, GLenum type, std::size_t bytes,
                  void* values) const;

  int width_;
  int height_;
  Stencil stencil_;
  Reading reading_;
  gl::Framebuffer framebuffer_;
  gl::Texture depth_;
  std::vector<gl::Texture> colours_;
};

/// Targets that frames are drawn into one after the other, of one method or of many: where a driver
/// draws in software, to get fresh memory takes as long as a small frame. A frame finds in them
/// what the last one left. Those of the last size are kept.
class SharedTargets {
 public:
  /// The target of a size and of these formats. It stays valid until another size is asked for.
  /// @throws InputError as Target
  const Target& get(int width, int height, const std::vector<GLenum>& formats) const;

 private:
  // What is there already; no result depends on it.
  mutable int width_ = 0;
  mutable int height_ = 0;
  mutable std::map<std::vector<GLenum>, Target> targets_;
};

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
