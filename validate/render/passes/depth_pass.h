#pragma once

#include <filesystem>

#include "render/passes/drawing.h"
#include "render/target.h"

namespace gnomon::render {

/// The depth map of Williams 1978: a mesh as the light sees it.
class LightDepthPass {
 public:
  explicit LightDepthPass(const std::filesystem::path& shaders);

  /// Fills the target's depth. Both sides of the surface cast shadows, as they do for a ray.
  void draw(const RenderView& light, const GpuMesh& mesh, const Target& target) const;

 private:
  gl::Program program_;
};

}  // namespace gnomon::render
