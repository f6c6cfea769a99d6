#include "render/line_pass.h"

#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "render/drawing.h"
#include "render/program.h"

namespace gnomon {

LinePass::LinePass(const std::filesystem::path& shaders)
    : program_(makeProgram({{readShader(shaders / "common/line.vert")},
                            {},
                            {readShader(shaders / "common/line.frag")}},
                           {})) {}

void LinePass::draw(const RenderView& view, std::span<const Vec3> ends, const glm::vec3& colour,
                    const Target& target) const {
  if (ends.empty()) return;
  const std::vector<glm::vec3> vertices(ends.begin(), ends.end());
  const gl::Buffer buffer = gl::makeBuffer();
  glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(vertices.size() * sizeof(glm::vec3)),
                       vertices.data(), 0);
  const gl::VertexArray layout = gl::makeVertexArray();
  glVertexArrayVertexBuffer(layout.name(), 0, buffer.name(), 0, sizeof(glm::vec3));
  glVertexArrayAttribFormat(layout.name(), 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(layout.name(), 0, 0);
  glEnableVertexArrayAttrib(layout.name(), 0);

  target.bind();
  glViewport(0, 0, view.width, view.height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  setUniform(program_.name(), "clipFromWorld", view.clipFromWorld);
  setUniform(program_.name(), "lineColour", Vec3(colour));
  glUseProgram(program_.name());
  glBindVertexArray(layout.name());
  glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(ends.size()));
}

}  // namespace gnomon
