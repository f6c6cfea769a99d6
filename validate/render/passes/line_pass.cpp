#include "render/passes/line_pass.h"

#include <array>
#include <vector>

#include "render/gl_objects.h"
#include "render/passes/drawing.h"
#include "render/program.h"

namespace gnomon::render {

LinePass::LinePass(const std::filesystem::path& shaders)
    : program_(makeProgram({{readShader(shaders / "common/line.vert")},
                            {},
                            {readShader(shaders / "common/line.frag")}},
                           {})) {}

void LinePass::draw(const RenderView& view, std::span<const Vec3> ends, const glm::vec3& colour,
                    const Target& target) const {
  if (ends.empty()) return;
  const std::vector<glm::vec3> vertices(ends.begin(), ends.end());
  const gl::Buffer buffer = gl::makeBuffer(std::as_bytes(std::span(vertices)));
  const std::array position = {gl::Attribute{0, 3, 0}};
  const gl::VertexArray layout = gl::makeVertexArray(buffer, sizeof(glm::vec3), position);
  setUniform(program_.name(), "clipFromWorld", view.clipFromWorld);
  setUniform(program_.name(), "lineColour", Vec3(colour));
  beginPass(target, program_.name(), Sides::both);
  glBindVertexArray(layout.name());
  glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(ends.size()));
}

}  // namespace gnomon::render
