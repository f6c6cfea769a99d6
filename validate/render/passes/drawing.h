#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/light.h"
#include "common/mask.h"
#include "common/vec.h"
#include "relief/relief.h"
#include "render/gl_objects.h"
#include "render/gpu_scene.h"
#include "render/method.h"
#include "render/program.h"
#include "surface/sample_grid.h"

namespace gnomon::render {

/// A mesh with its relief and light: the input of a pass.
struct Drawing {
  const GpuMesh& mesh;
  const GpuHeights& heights;
  relief::Wrap wrap;
  relief::HeightSpace heightSpace;
  double texelsPerHeight;  ///< of the frame of angles (angle_table.h)
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
