#include "render/view.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "common/error.h"

namespace gnomon {
namespace {

struct Sphere {
  Vec3 centre;
  double radius;
};

Sphere boundingSphere(const BaseMesh& mesh) {
  Vec3 low(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (const BaseVertex& vertex : mesh.vertices) {
    low = glm::min(low, vertex.position);
    high = glm::max(high, vertex.position);
  }
  return {(low + high) / 2.0, glm::length(high - low) / 2};
}

}  // namespace

RenderView cameraView(const Camera& camera, const BaseMesh& mesh) {
  const Vec3 back = camera.eye - camera.target;
  if (glm::length(glm::cross(back, camera.up)) <=
      1e-9 * glm::length(back) * glm::length(camera.up)) {
    throw InputError("view: `eye`, `target` and `up` lie on one line, no camera looks that way");
  }
  const Sphere bounds = boundingSphere(mesh);
  const double distance = glm::length(camera.eye - bounds.centre);
  const double farthest = 1.01 * (distance + bounds.radius);
  const double nearest = std::max(0.99 * (distance - bounds.radius), 1e-4 * farthest);
  const double aspect = static_cast<double>(camera.width) / camera.height;
  const glm::dmat4 clip = glm::perspective(camera.verticalFov, aspect, nearest, farthest) *
                          glm::lookAt(camera.eye, camera.target, camera.up);
  return {camera.width, camera.height, glm::mat4(clip), {0, 0}};
}

RenderView atlasView(const LimitSurface& surface, int samplesPerSide) {
  int columns = 0;
  int rows = 0;
  if (const auto grid = surface.grid()) {
    columns = grid->columns;
    rows = grid->rows;
  } else {
    columns = static_cast<int>(std::ceil(std::sqrt(surface.faceCount())));
    rows = (surface.faceCount() + columns - 1) / columns;
  }
  return {columns * samplesPerSide, rows * samplesPerSide, glm::mat4(1), {columns, rows}};
}

}  // namespace gnomon
