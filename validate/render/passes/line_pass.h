#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <span>

#include "common/vec.h"
#include "render/gl_handles.h"
#include "render/target.h"
#include "render/view.h"

namespace gnomon::render {

/// Draws lines into a picture, hidden where the surface that was drawn before is nearer.
class LinePass {
 public:
  explicit LinePass(const std::filesystem::path& shaders);

  /// @param ends    world; two a line
  /// @param colour  sRGB, 0 to 1
  /// @param target  holds the depth of what was drawn in the same view
  void draw(const RenderView& view, std::span<const Vec3> ends, const glm::vec3& colour,
            const Target& target) const;

 private:
  gl::Program program_;
};

}  // namespace gnomon::render
