#include "render/check/rectangles.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "surface/face_grids.h"

namespace gnomon::render {
namespace {

constexpr int texelsPerSide = 8;

Vec3 outside(const Rectangle& r) {
  return glm::normalize(glm::cross(r.along, r.across));
}

/// Lengths are sums of halves to the power of some number, so that cuts of neighbouring rectangles
/// coincide to the bit.
std::array<Rectangle, 7> makeRectangles() {
  const Vec3 low(-3.375, -0.875, 2.25);
  const Vec3 high(0.75, 2.25, 5.125);
  const Vec3 x(high.x - low.x, 0, 0);
  const Vec3 y(0, high.y - low.y, 0);
  const Vec3 z(0, 0, high.z - low.z);
  return {{{{-8, -8, 0}, {16, 0, 0}, {0, 16, 0}},
           {low, y, x},
           {low, x, z},
           {low, z, y},
           {high, -x, -y},
           {high, -z, -x},
           {high, -y, -z}}};
}

/// The way along a ray to a rectangle, in lengths of `direction`; none where it does not meet it.
std::optional<double> distanceTo(const Rectangle& r, const Vec3& origin, const Vec3& direction) {
  const Vec3 normal = outside(r);
  const double slope = glm::dot(normal, direction);
  if (slope == 0) return std::nullopt;
  const double distance = glm::dot(normal, r.corner - origin) / slope;
  const Vec3 from = origin + distance * direction - r.corner;
  const double s = glm::dot(from, r.along) / glm::dot(r.along, r.along);
  const double t = glm::dot(from, r.across) / glm::dot(r.across, r.across);
  const bool isOn = s >= 0 && s <= 1 && t >= 0 && t <= 1;
  return isOn ? std::optional(distance) : std::nullopt;
}

SeenPoint seenFrom(const Vec3& eye, const Vec3& direction, const Vec3& light) {
  SeenPoint seen;
  double nearest = std::numeric_limits<double>::infinity();
  const auto& rectangles = boxOverFloor();
  for (std::size_t k = 0; k < rectangles.size(); ++k) {
    if (glm::dot(outside(rectangles[k]), direction) >= 0) continue;
    const auto distance = distanceTo(rectangles[k], eye, direction);
    if (!distance || *distance <= 0 || *distance >= nearest) continue;
    nearest = *distance;
    seen.face = static_cast<int>(k);
  }
  if (seen.face < 0) return seen;
  const Rectangle& own = rectangles[static_cast<std::size_t>(seen.face)];
  const Vec3 point = eye + nearest * direction;
  const Vec3 from = point - own.corner;
  seen.st = {glm::dot(from, own.along) / glm::dot(own.along, own.along),
             glm::dot(from, own.across) / glm::dot(own.across, own.across)};
  seen.isTurned = !(glm::dot(outside(own), light) > 0);
  seen.isHidden = seen.isTurned;
  for (const Rectangle& other : rectangles) {
    if (&other == &own) continue;
    const auto distance = distanceTo(other, point, light);
    seen.isHidden = seen.isHidden || (distance && *distance > 0);
  }
  return seen;
}

surface::BaseVertex vertexOf(const Rectangle& r, int face, Vec2 st) {
  constexpr double texels = texelsPerSide;
  return {{r.corner + st.x * r.along + st.y * r.across, outside(r), r.along / texels,
           r.across / texels, texels * st, true},
          {0, 0, glm::normalize(r.along), glm::normalize(r.across)},
          face,
          st};
}

}  // namespace

const std::array<Rectangle, 7>& boxOverFloor() {
  static const std::array<Rectangle, 7> rectangles = makeRectangles();
  return rectangles;
}

displaced::DisplacedMesh boxOverFloorMesh() {
  // The floor has four pieces a side, the box's sides have two.
  std::vector<surface::FaceLines> lines(boxOverFloor().size(), surface::FaceLines{1, 1});
  lines.front() = {0, 0};
  const surface::FaceGrids grids({surface::evenLines(4), surface::evenLines(2)}, lines);
  displaced::DisplacedMesh result;
  for (std::size_t k = 0; k < boxOverFloor().size(); ++k) {
    const surface::FaceGrid& grid = grids.faces()[k];
    for (const double t : grids.tLines(grid)) {
      for (const double s : grids.sLines(grid)) {
        result.mesh.vertices.push_back(
            vertexOf(boxOverFloor().at(k), static_cast<int>(k), Vec2(s, t)));
      }
    }
  }
  result.mesh.triangles = surface::gridTriangles(grids, surface::Diagonal::fromOrigin);
  std::map<std::tuple<double, double, double>, std::uint32_t> places;
  std::vector<std::uint32_t> shared;
  for (const surface::BaseVertex& vertex : result.mesh.vertices) {
    const Vec3& p = vertex.frame.position;
    shared.push_back(
        places.emplace(std::tuple(p.x, p.y, p.z), static_cast<std::uint32_t>(shared.size()))
            .first->second);
  }
  result.adjacency = displaced::triangleAdjacency(result.mesh, shared);
  return result;
}

std::vector<SeenPoint> seenPoints(const Camera& camera, const Vec3& light) {
  const CameraAxes axis = axes(camera);
  std::vector<SeenPoint> points;
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      points.push_back(seenFrom(camera.eye, pixelDirection(camera, axis, column, row), light));
    }
  }
  const auto at = [&](int column, int row) -> SeenPoint& {
    return points[static_cast<std::size_t>(row * camera.width + column)];
  };
  for (int row = 1; row + 1 < camera.height; ++row) {
    for (int column = 1; column + 1 < camera.width; ++column) {
      SeenPoint& own = at(column, row);
      own.isClear = true;
      for (int k = 0; k < 9; ++k) {
        const SeenPoint& other = at(column + k % 3 - 1, row + k / 3 - 1);
        own.isClear = own.isClear && other.face == own.face && other.isHidden == own.isHidden;
      }
    }
  }
  return points;
}

}  // namespace gnomon::render
