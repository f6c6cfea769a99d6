#pragma once

#include <filesystem>

#include "render/passes/drawing.h"
#include "render/target.h"

namespace gnomon::render {

/// Shadow volumes (Crow 1977) of a displaced mesh, counted in the stencil behind what the camera
/// sees (z-fail), so that a camera inside a shadow counts right.
///
/// Every triangle, turned to the light or not, shades what lies behind it: an open patch has no
/// inside to rely on. Its volume is the triangle and, from each side across which the neighbour
/// does not face the light as it does, a triangle to the point at infinity that the light points
/// to. Volumes of neighbours that face alike join without a wall. The count is 0 where light
/// arrives.
class ShadowVolumePass {
 public:
  explicit ShadowVolumePass(const std::filesystem::path& shaders);

  /// Draws the mesh's depth, then counts. The target needs a stencil; the view is a camera's.
  void draw(const RenderView& view, const Drawing& drawing, const Target& target) const;

 private:
  gl::Program depth_;
  gl::Program volumes_;
};

}  // namespace gnomon::render
