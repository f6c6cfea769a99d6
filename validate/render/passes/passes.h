#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/mask.h"
#include "common/visibility.h"
#include "render/passes/drawing.h"
#include "render/target.h"
#include "surface/sample_grid.h"

namespace gnomon::render {

/// The G-buffer pass: which sample each pixel shows.
class SamplesPass {
 public:
  explicit SamplesPass(const std::filesystem::path& shaders);
  /// @throws InputError if the view is larger than GL's largest texture
  [[nodiscard]] surface::SampleGrid render(const RenderView& view, const GpuMesh& mesh) const;

 private:
  gl::Program program_;
};

/// The picture of a mask, or of shares of light: diffuse light as far as it is lit, by the normal
/// that decides a method's drawn answer, so that picture and mask agree: a lit pixel is brighter
/// than a shadowed one, and brightness before gamma is linear in the share. RGB, 8 bits, row 0 at
/// the top; background white.
class ShadePass {
 public:
  /// @param mesh  whether the drawn mesh is bump-mapped, or displaced and shaded facet by facet
  ShadePass(const std::filesystem::path& shaders, relief::Wrap wrap, DrawnMesh mesh);
  [[nodiscard]] std::vector<std::uint8_t> render(const RenderView& view, const Drawing& drawing,
                                                 const Mask& mask) const;
  [[nodiscard]] std::vector<std::uint8_t> render(const RenderView& view, const Drawing& drawing,
                                                 const Visibility& visibility) const;
  /// The same, drawn into a target's first attachment.
  /// @param target  of the view's size, with a colour attachment GL_RGBA8
  void draw(const RenderView& view, const Drawing& drawing, const Mask& mask,
            const Target& target) const;
  void draw(const RenderView& view, const Drawing& drawing, const Visibility& visibility,
            const Target& target) const;

 private:
  gl::Program program_;
};

}  // namespace gnomon::render
