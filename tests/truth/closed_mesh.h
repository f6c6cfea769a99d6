#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <random>
#include <utility>

#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"

namespace gnomon::test {

/// Rays in random directions from a point inside a closed surface that meet nothing.
inline int escapes(const truth::MicroMesh& mesh, const Vec3& inside, int rays) {
  const truth::MicroScene scene(mesh);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  int escaped = 0;
  for (int k = 0; k < rays; ++k) {
    const Vec3 direction = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
    escaped += scene.nearest(inside - mesh.centre(), direction) ? 0 : 1;
  }
  return escaped;
}

struct EdgeCount {
  std::size_t all = 0;
  std::size_t open = 0;  ///< of an odd number of triangles
};

/// The triangles at every edge, which is told by its ends' positions, bit for bit: what rays can
/// only sample, an edge count proves. Without edges of no length. Sheets that happen to coincide
/// leave an even number.
inline EdgeCount countEdges(const truth::MicroMesh& mesh) {
  using Point = std::array<float, 3>;
  std::map<std::pair<Point, Point>, int> edges;
  const auto point = [&](std::size_t v) {
    return Point{mesh.coordinates()[3 * v], mesh.coordinates()[3 * v + 1],
                 mesh.coordinates()[3 * v + 2]};
  };
  const auto addEdge = [&](std::size_t a, std::size_t b) {
    const auto low = std::min(point(a), point(b));
    const auto high = std::max(point(a), point(b));
    if (low != high) ++edges[{low, high}];
  };
  for (const surface::FaceGrid& grid : mesh.grids().faces()) {
    const auto stride = static_cast<std::size_t>(grid.columns);
    for (std::size_t j = 0; j + 1 < static_cast<std::size_t>(grid.rows); ++j) {
      for (std::size_t i = 0; i + 1 < stride; ++i) {
        const std::size_t v = grid.firstVertex + j * stride + i;
        for (const auto& [a, b, c] :
             {std::array{v, v + 1, v + stride}, std::array{v + stride + 1, v + stride, v + 1}}) {
          addEdge(a, b);
          addEdge(b, c);
          addEdge(c, a);
        }
      }
    }
  }
  EdgeCount count{edges.size(), 0};
  for (const auto& [edge, triangles] : edges) count.open += triangles % 2 == 0 ? 0U : 1U;
  return count;
}

}  // namespace gnomon::test
