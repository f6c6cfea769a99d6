#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "relief/relief.h"
#include "render/gpu_scene.h"
#include "render/method.h"
#include "render/program.h"
#include "render/view.h"

namespace gnomon {

/// What a pass draws, lit from where.
struct Drawing {
  const GpuMesh& mesh;
  const GpuHeights& heights;
  Wrap wrap;
  HeightSpace heightSpace;
  double texelsPerHeight;               ///< of the frame of angles (texel_scale.h)
  Vec3 light{0, 0, 1};                  ///< unit vector toward the light, world
  const GpuVolumes* volumes = nullptr;  ///< of a displaced mesh
  const RenderView* texture = nullptr;  ///< the texture's own plane, for methods that draw there
};

// What every pass shares.

/// The texture units, each with one texture for all passes.
enum class TextureUnit : GLuint {
  heights,
  horizon,
  distance,
  mask,
  angles,
  basis,
  arccos,
  resolved,
  ellipse,
  lightDepth,
  shadowCount,
};

/// A program whose vertex stage is the one that all passes of a view share (surface.vert).
gl::Program makeSurfaceProgram(const std::filesystem::path& shaders,
                               const std::vector<ShaderPiece>& fragment,
                               const std::vector<std::string>& defines);

/// The defines that wrap.glsl, pixel.glsl and shading.glsl read.
std::vector<std::string> surfaceDefines(Wrap wrap, DrawnMesh mesh);

void bindTexture(GLuint program, TextureUnit unit, GLuint texture, const char* sampler);
void setUniform(GLuint program, const char* name, const Vec3& value);
void setUniform(GLuint program, const char* name, glm::vec2 value);
void setUniform(GLuint program, const char* name, const glm::mat4& value);
void setView(GLuint program, const RenderView& view);
/// Light, height space and the height map with its border.
void setDrawing(GLuint program, const Drawing& drawing);

/// Which sides of its triangles a pass draws.
enum class Sides { front, both };

/// Draws a mesh with the nearest surface on top; in a texture's plane both sides, since charts may
/// be mirrored.
void drawMesh(GLuint program, const RenderView& view, const GpuMesh& mesh,
              Sides sides = Sides::front);

}  // namespace gnomon
