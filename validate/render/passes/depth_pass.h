#pragma once

#include <filesystem>

#include "render/passes/drawing.h"
#include "render/target.h"

namespace gnomon::render {

/// The depth of a mesh alone: the depth map of Williams 1978, where the light sees it.
class DepthPass {
 public:
  explicit DepthPass(const std::filesystem::path& shaders);

  /// Fills the target's depth. For a light both sides of the surface count: they cast shadows, as
  /// they do for a ray.
  void draw(const RenderView& view, const GpuMesh& mesh, const Target& target, Sides sides) const;

 private:
  gl::Program program_;
};

}  // namespace gnomon::render
