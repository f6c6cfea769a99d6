#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "common/camera.h"
#include "render/gpu_scene.h"
#include "surface/base_mesh.h"
#include "surface/limit_surface.h"

namespace gnomon::render {

/// The projection of a mesh into a picture, which determines the view's samples.
struct RenderView {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  glm::mat4 clipFromWorld{1};
  /// Columns and rows of face tiles for an atlas, zero for a camera.
  glm::ivec2 atlasTiles{0, 0};
  /// Of a texture's own plane: the texel coordinates of its lower left corner, and its size in
  /// texels; zero for other views.
  glm::ivec4 texelWindow{0, 0, 0, 0};
  /// Of a camera, world; no number for other views.
  glm::vec3 eye{std::numeric_limits<float>::quiet_NaN()};
};

/// The camera as OpenGL has it: clip = projection · view · (x, y, z, 1), all three right-handed but
/// clip space; the camera looks along -z of view space with +y up, depth runs from -1 (near) to 1.
struct CameraMatrices {
  glm::dmat4 view;        ///< camera from world
  glm::dmat4 projection;  ///< clip from camera
};

/// Near and far hold the mesh's bounding sphere.
/// @throws InputError as `cameraView`
CameraMatrices cameraMatrices(const Camera& camera, const surface::BaseMesh& mesh);

/// One sample a pixel, as Figure 8 shows the surface; faces turned from the camera are not drawn.
/// @throws InputError if the eye is at the target or `up` points along the view
RenderView cameraView(const Camera& camera, const surface::BaseMesh& mesh);

/// A regular grid of `samplesPerSide`² samples over every face's parameters, each face a square
/// tile; a grid chart keeps its faces side by side, others fill rows of a square. Parameters of
/// sample (i, j) of a face: ((i + 0.5) / samplesPerSide, (j + 0.5) / samplesPerSide), t upward.
RenderView atlasView(const surface::LimitSurface& surface, int samplesPerSide);

/// The texture's own plane, one pixel a texel: all texels that the mesh's texture coordinates
/// reach, each unique. Where charts overlap, one of them shows. Sides end at 2³⁰.
RenderView textureView(const surface::BaseMesh& mesh);

/// @throws InputError if the view has more than 2²⁷ texels, MemoryError if they cannot fit
void requireTextureView(const RenderView& view);

/// The mesh as a directional light sees it: an orthographic picture of its bounding sphere, depth 0
/// where the sphere is nearest to the light, 1 where it is farthest.
/// @param light  unit vector toward the light
RenderView lightView(const Sphere& bounds, const Vec3& light, int side);

}  // namespace gnomon::render
