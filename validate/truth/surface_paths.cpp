#include "truth/surface_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/parallel.h"
#include "surface/face_grids.h"

namespace gnomon::truth {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

int cellsFor(int faces) {
  const double wanted = std::sqrt(65536.0 / faces);
  return std::clamp(static_cast<int>(std::ceil(wanted)), 1, 64);
}

double distanceTo(const Vec3& from, const Vec3& to, const Vec3& point) {
  const Vec3 along = to - from;
  const double square = glm::dot(along, along);
  const double share = square > 0 ? glm::dot(point - from, along) / square : 0;
  return glm::length(from + std::clamp(share, 0.0, 1.0) * along - point);
}

}  // namespace

SurfacePaths::SurfacePaths(const surface::LimitSurface& surface)
    : cells_(cellsFor(surface.faceCount())) {
  placeVertices(surface);
  connect();
  labelPieces();
}

void SurfacePaths::placeVertices(const surface::LimitSurface& surface) {
  const auto grids = surface::FaceGrids::even(surface.faceCount(), cells_);
  points_.resize(grids.vertexCount());
  parallelFor(0, grids.faces().size(), [&](std::size_t face) {
    const surface::FaceGrid& grid = grids.faces()[face];
    std::size_t vertex = grid.firstVertex;
    for (const double t : grids.tLines(grid)) {
      for (const double s : grids.sLines(grid)) {
        points_[vertex++] = surface.tangentPoint(static_cast<int>(face), s, t).position;
      }
    }
  });
  triangles_ = surface::gridTriangles(grids, surface::Diagonal::fromOrigin);
  const std::vector<Index> first = surface::firstVertices(surface, grids);
  for (Index& vertex : triangles_) vertex = first[vertex];
  for (std::size_t side = 0; side < triangles_.size(); ++side) {
    longest_ = std::max(longest_,
                        glm::length(corner(side / 3, side % 3 + 1) - corner(side / 3, side % 3)));
  }
}

void SurfacePaths::connect() {
  using Edge = std::pair<std::uint64_t, Index>;  // its two vertices; a side
  std::vector<Edge> edges;
  edges.reserve(triangles_.size());
  for (std::size_t side = 0; side < triangles_.size(); ++side) {
    const std::uint64_t a = triangles_[side];
    const std::uint64_t b = triangles_[side - side % 3 + (side + 1) % 3];
    edges.emplace_back(std::min(a, b) << 32U | std::max(a, b), static_cast<Index>(side));
  }
  std::sort(edges.begin(), edges.end());
  neighbours_.assign(triangles_.size(), none);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i].first != edges[i + 1].first) continue;
    neighbours_[edges[i].second] = edges[i + 1].second;
    neighbours_[edges[i + 1].second] = edges[i].second;
  }
}

void SurfacePaths::labelPieces() {
  const std::size_t count = triangles_.size() / 3;
  pieces_.assign(count, none);
  std::vector<std::size_t> open;
  for (std::size_t seed = 0; seed < count; ++seed) {
    if (pieces_[seed] != none) continue;
    pieces_[seed] = static_cast<Index>(seed);
    open.push_back(seed);
    while (!open.empty()) {
      const std::size_t triangle = open.back();
      open.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const Index across = neighbours_[3 * triangle + k];
        if (across == none || pieces_[across / 3] != none) continue;
        pieces_[across / 3] = static_cast<Index>(seed);
        open.push_back(across / 3);
      }
    }
  }
}

SurfacePaths::Place SurfacePaths::placeOf(const surface::SurfaceSample& sample) const {
  const auto cellOf = [&](double parameter) {
    return std::clamp(static_cast<int>(parameter * cells_), 0, cells_ - 1);
  };
  const int column = cellOf(sample.s);
  const int row = cellOf(sample.t);
  const double s = static_cast<double>(sample.s) * cells_ - column;
  const double t = static_cast<double>(sample.t) * cells_ - row;
  const auto cells = static_cast<std::size_t>(cells_);
  const std::size_t cell =
      (static_cast<std::size_t>(sample.face) * cells + static_cast<std::size_t>(row)) * cells +
      static_cast<std::size_t>(column);
  // As gridTriangles cuts the cell, from (0, 0) to (1, 1).
  const bool isFirst = s >= t;
  std::array<double, 3> weights =
      isFirst ? std::array{1 - s, s - t, t} : std::array{1 - t, s, t - s};
  // Inside the triangle, so that the section's plane cuts two of its sides.
  double sum = 0;
  for (double& weight : weights) sum += weight = std::max(weight, 1e-6);
  Place place{2 * cell + (isFirst ? 0 : 1), Vec3(0)};
  for (std::size_t k = 0; k < 3; ++k)
    place.point += weights.at(k) / sum * corner(place.triangle, k);
  return place;
}

bool SurfacePaths::passes(std::size_t triangle, const Vec3& from, const Vec3& to,
                          const PathTarget& target) const {
  const Vec3& a = corner(triangle, 0);
  const Vec3& b = corner(triangle, 1);
  const Vec3& c = corner(triangle, 2);
  const double side = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  return glm::dot(glm::cross(b - a, c - a), target.normal) >= 0 &&
         distanceTo(from, to, target.point) <= target.reach + side;
}

bool SurfacePaths::leadTo(const PathStart& start, const PathTarget& target) const {
  const Place origin = placeOf(start.sample);
  const auto targetCell = static_cast<std::size_t>(target.face) * static_cast<std::size_t>(cells_) *
                          static_cast<std::size_t>(cells_);
  if (pieces_[origin.triangle] != pieces_[2 * targetCell]) return false;
  const Vec3 across = glm::cross(start.normal, start.light);  // the plane's normal
  if (!(glm::length(across) > 1e-9))
    return passes(origin.triangle, origin.point, origin.point, target);
  const Vec3 ahead = glm::normalize(glm::cross(across, start.normal));  // e
  std::size_t triangle = origin.triangle;
  Vec3 from = origin.point;
  std::size_t entered = 3;  // by no side
  for (std::size_t step = 0; step < triangles_.size(); ++step) {
    // The side that the path leaves by: of the two that the plane cuts the one not entered by, in
    // the first triangle the one toward the light.
    std::optional<std::size_t> left;
    Vec3 to(0);
    for (std::size_t k = 0; k < 3; ++k) {
      if (k == entered) continue;
      const double begin = glm::dot(corner(triangle, k) - origin.point, across);
      const double end = glm::dot(corner(triangle, k + 1) - origin.point, across);
      if ((begin >= 0) == (end >= 0)) continue;
      const Vec3 crossing = corner(triangle, k) +
                            begin / (begin - end) * (corner(triangle, k + 1) - corner(triangle, k));
      if (left && !(glm::dot(crossing - to, ahead) > 0)) continue;
      left = k;
      to = crossing;
    }
    if (!left || glm::dot(to - from, ahead) < -1e-9 * longest_) return false;
    if (passes(triangle, from, to, target)) return true;
    if (glm::dot(to - target.point, ahead) > target.reach + longest_) return false;
    const Index next = neighbours_[3 * triangle + *left];
    if (next == none) return false;
    triangle = next / 3;
    entered = next % 3;
    from = to;
  }
  return false;
}

}  // namespace gnomon::truth
