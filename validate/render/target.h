#pragma once

#include <algorithm>
#include <vector>

#include "render/gl_handles.h"

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

}  // namespace gnomon::render
