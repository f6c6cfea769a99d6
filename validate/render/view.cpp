#include "render/view.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "common/error.h"
#include "common/system/memory.h"

namespace gnomon::render {
namespace {

/// Any unit vector across a given one.
Vec3 across(const Vec3& direction) {
  const Vec3 axis = std::abs(direction.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  return glm::normalize(glm::cross(direction, axis));
}

}  // namespace

CameraMatrices cameraMatrices(const Camera& camera, const surface::BaseMesh& mesh) {
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
  return {glm::lookAt(camera.eye, camera.target, camera.up),
          glm::perspective(camera.verticalFov, aspect, nearest, farthest)};
}

RenderView cameraView(const Camera& camera, const surface::BaseMesh& mesh) {
  const CameraMatrices matrices = cameraMatrices(camera, mesh);
  const glm::dmat4 clip = matrices.projection * matrices.view;
  return {camera.width, camera.height, glm::mat4(clip),
          {0, 0},       {0, 0, 0, 0},  glm::vec3(camera.eye)};
}

RenderView atlasView(const surface::LimitSurface& surface, int samplesPerSide) {
  int columns = 0;
  int rows = 0;
  if (const auto grid = surface.grid()) {
    columns = grid->columns;
    rows = grid->rows;
  } else {
    columns = static_cast<int>(std::ceil(std::sqrt(surface.faceCount())));
    rows = (surface.faceCount() + columns - 1) / columns;
  }
  RenderView view;
  view.width = columns * samplesPerSide;
  view.height = rows * samplesPerSide;
  view.atlasTiles = {columns, rows};
  return view;
}

RenderView textureView(const surface::BaseMesh& mesh) {
  Vec2 low(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
  for (const surface::BaseVertex& vertex : mesh.vertices) {
    low = glm::min(low, vertex.frame.texel);
    high = glm::max(high, vertex.frame.texel);
  }
  // Rounding must not add a row of texels that only a border touches.
  constexpr double slack = 1e-6;
  low = glm::floor(low + slack);
  const Vec2 size = glm::max(glm::ceil(high - slack) - low, Vec2(1));
  constexpr double longestSide = 1 << 30;
  low = glm::clamp(low, -longestSide, longestSide);
  RenderView view;
  view.width = static_cast<int>(std::min(size.x, longestSide));
  view.height = static_cast<int>(std::min(size.y, longestSide));
  view.texelWindow = glm::ivec4(glm::ivec2(low), view.width, view.height);
  return view;
}

void requireTextureView(const RenderView& view) {
  constexpr double mostTexels = 1 << 27;
  const double texels = static_cast<double>(view.width) * view.height;
  const std::string what =
      fmt::format("{} × {} unique texels on the surface", view.width, view.height);
  if (!(texels <= mostTexels)) {
    throw InputError(fmt::format("{} found, at most {} expected: fewer repeats", what, mostTexels));
  }
  constexpr double bytesPerTexel = 32;  // a sample, and what the passes keep
  requireMemory(texels * bytesPerTexel, what);
}

RenderView lightView(const Sphere& bounds, const Vec3& light, int side) {
  const double radius = 1.0001 * bounds.radius;
  const glm::dmat4 clip = glm::ortho(-radius, radius, -radius, radius, 0.0, 2 * radius) *
                          glm::lookAt(bounds.centre + radius * light, bounds.centre, across(light));
  RenderView view;
  view.width = side;
  view.height = side;
  view.clipFromWorld = glm::mat4(clip);
  return view;
}

}  // namespace gnomon::render
