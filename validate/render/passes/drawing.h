#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/light.h"
#include "relief/relief.h"
#include "render/gpu_scene.h"
#include "render/method.h"
#include "render/program.h"
#include "render/target.h"
#include "render/view.h"

namespace gnomon::render {

/// A mesh with its relief and light: the input of a pass.
struct Drawing {
  const GpuMesh& mesh;
  const GpuHeights& heights;
  relief::Wrap wrap;
  relief::HeightSpace heightSpace;
  double texelsPerHeight;  ///< of the frame of angles (texel_scale.h)
  Light light = {};
  const GpuVolumes* volumes = nullptr;  ///< of a displaced mesh
  const RenderView* texture = nullptr;  ///< the texture's own plane, for methods that draw there
  const GpuMesh* lightMesh = nullptr;   ///< of a method that has one of its own for its light
};

/// The texture units, each with one texture for all passes.
enum class TextureUnit : GLuint {
  heights,
  horizon,
  distance,
  shares,
  angles,
  basis,
  arccos,
  resolved,
  ellipse,
  lightDepth,
  shadowCount,
  cameraDepth,
  own,  ///< the first of those that a method declares
};

/// The texture unit of one of them, by its place among a method's own textures.
inline TextureUnit ownUnit(std::size_t place) {
  return static_cast<TextureUnit>(static_cast<GLuint>(TextureUnit::own) + place);
}

/// A program whose vertex stage is the one that all passes of a view share (surface.vert).
gl::Program makeSurfaceProgram(const std::filesystem::path& shaders,
                               const std::vector<ShaderPiece>& fragment,
                               const std::vector<std::string>& defines);

/// The defines that wrap.glsl, pixel.glsl and shading.glsl read.
std::vector<std::string> surfaceDefines(relief::Wrap wrap, DrawnMesh mesh);

void bindTexture(GLuint program, TextureUnit unit, GLuint texture, const char* sampler);
// A uniform that the program does not use is left out.
void setUniform(GLuint program, const char* name, int value);
void setUniform(GLuint program, const char* name, double value);
void setUniform(GLuint program, const char* name, glm::ivec2 value);
void setUniform(GLuint program, const char* name, glm::vec2 value);
void setUniform(GLuint program, const char* name, const Vec3& value);
void setUniform(GLuint program, const char* name, const glm::vec4& value);
void setUniform(GLuint program, const char* name, const glm::mat4& value);
void setView(GLuint program, const RenderView& view);
/// The height map with its border, and in which units and frames it stands.
void setRelief(GLuint program, const GpuHeights& heights, relief::HeightSpace space,
               double texelsPerHeight);
/// Light and relief.
void setDrawing(GLuint program, const Drawing& drawing);

/// Which sides of its triangles a pass draws.
enum class Sides { front, both };

/// Begins a pass: what is drawn next fills the whole target by this program, the nearest surface on
/// top. Sets every state that another pass may have left otherwise, so that passes are independent.
void beginPass(const Target& target, GLuint program, Sides sides);

/// A pass that draws a mesh; in a texture's plane both sides, since charts may be mirrored.
/// @param target  of the view's size
void drawMesh(const Target& target, GLuint program, const RenderView& view, const GpuMesh& mesh,
              Sides sides = Sides::front);

/// Draws over all of the viewport of the framebuffer that is bound, without mesh and depth
/// (plane.vert).
void drawPlane(GLuint program);

}  // namespace gnomon::render
