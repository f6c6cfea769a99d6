#pragma once

#include <glm/glm.hpp>

#include "common/camera.h"
#include "surface/base_mesh.h"
#include "surface/limit_surface.h"

namespace gnomon {

/// How the base mesh is laid out in a picture: which samples the view chooses.
struct RenderView {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  glm::mat4 clipFromWorld{1};
  /// Columns and rows of face tiles for an atlas, zero for a camera.
  glm::ivec2 atlasTiles{0, 0};
};

/// One sample a pixel, as Figure 8 shows the surface; faces turned from the camera are not drawn.
/// @throws InputError if the eye is at the target or `up` points along the view
RenderView cameraView(const Camera& camera, const BaseMesh& mesh);

/// A regular grid of `samplesPerSide`² samples over every face's parameters, each face a square
/// tile; a grid chart keeps its faces side by side, others fill rows of a square. Parameters of
/// sample (i, j) of a face: ((i + 0.5) / samplesPerSide, (j + 0.5) / samplesPerSide), t upward.
RenderView atlasView(const LimitSurface& surface, int samplesPerSide);

}  // namespace gnomon
