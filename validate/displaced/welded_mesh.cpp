#include "displaced/welded_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "surface/closed_surface.h"
#include "surface/shared_vertices.h"
#include "surface/texel_frame.h"

namespace gnomon {
namespace {

constexpr int mostSubdivisions = 8192;

double triangleCount(const LimitSurface& surface, int subdivisions) {
  return 2.0 * subdivisions * subdivisions * surface.faceCount();
}

/// Refuses a mesh that cannot be numbered or held, before anything of it is made.
void requireRoom(const LimitSurface& surface, int subdivisions) {
  const std::string what = fmt::format("subdivisions: {}", subdivisions);
  if (subdivisions < 1 || subdivisions > mostSubdivisions) {
    throw InputError(fmt::format("{} found, 1 to {} expected", what, mostSubdivisions));
  }
  const double vertices = (subdivisions + 1.0) * (subdivisions + 1.0) * surface.faceCount();
  if (!(vertices < std::numeric_limits<std::int32_t>::max())) {
    throw InputError(fmt::format("{} found, which give {:.3g} vertices: fewer than 2^31 expected",
                                 what, vertices));
  }
  const double triangles = triangleCount(surface, subdivisions);
  constexpr double bytesPerVertex = 2 * sizeof(glm::vec3) + 2 * sizeof(std::uint32_t);
  constexpr double bytesPerTriangle = 3 * sizeof(std::uint32_t);
  requireMemory(vertices * bytesPerVertex + triangles * bytesPerTriangle,
                fmt::format("{}, a displaced mesh of {:.3g} triangles", what, triangles));
}

/// All faces' vertices, each with its own, and for each the one that it is the same as.
struct Vertices {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> same;
};

Vertices allVertices(const LimitSurface& surface, const Relief& relief, int subdivisions) {
  const std::size_t side = static_cast<std::size_t>(subdivisions) + 1;
  const auto faces = static_cast<std::size_t>(surface.faceCount());
  Vertices all;
  all.positions.resize(faces * side * side);
  all.same.resize(all.positions.size());
  const Vec2 texelsPerUv = relief.texelsPerUv();
  parallelFor(0, faces, [&](std::size_t face) {
    for (std::size_t v = 0; v < side * side; ++v) {
      const std::size_t column = v % side;
      const std::size_t row = v / side;
      const double s = static_cast<double>(column) / subdivisions;
      const double t = static_cast<double>(row) / subdivisions;
      const LimitPoint point = surface.evaluate(static_cast<int>(face), s, t);
      const std::size_t index = face * side * side + v;
      all.positions[index] = glm::vec3(displaced(relief, texelFrame(point, texelsPerUv)));
      all.same[index] = static_cast<std::uint32_t>(index);
    }
  });
  forEachSharedVertex(
      surface,
      [side](std::size_t face) {
        return FaceGrid{static_cast<std::uint32_t>(face * side * side), static_cast<int>(side),
                        static_cast<int>(side)};
      },
      [&](std::size_t first, std::size_t vertex) {
        all.same[vertex] = static_cast<std::uint32_t>(first);
      });
  return all;
}

/// Leaves each vertex once: `same` becomes its number among those, which `positions` then holds.
void weld(Vertices& all) {
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < all.positions.size(); ++v) {
    // The first of vertices that are the same comes before the others.
    if (all.same[v] == v) {
      all.positions[kept] = all.positions[v];
      all.same[v] = kept++;
    } else {
      all.same[v] = all.same[all.same[v]];
    }
  }
  all.positions.resize(kept);
}

std::vector<std::uint32_t> trianglesOf(const std::vector<std::uint32_t>& numbers, std::size_t faces,
                                       std::size_t pieces) {
  const std::size_t side = pieces + 1;
  std::vector<std::uint32_t> triangles;
  triangles.reserve(faces * pieces * pieces * 6);
  for (std::size_t face = 0; face < faces; ++face) {
    for (std::size_t cell = 0; cell < pieces * pieces; ++cell) {
      const std::size_t first = face * side * side + cell / pieces * side + cell % pieces;
      const std::uint32_t v00 = numbers[first];
      const std::uint32_t v10 = numbers[first + 1];
      const std::uint32_t v01 = numbers[first + side];
      const std::uint32_t v11 = numbers[first + side + 1];
      triangles.insert(triangles.end(), {v00, v10, v01, v11, v01, v10});
    }
  }
  return triangles;
}

}  // namespace

WeldedMesh makeWeldedMesh(const LimitSurface& surface, const Relief& relief, int subdivisions) {
  requireRoom(surface, subdivisions);
  Vertices vertices = allVertices(surface, relief, subdivisions);
  weld(vertices);
  vertices.positions.shrink_to_fit();
  return {std::move(vertices.positions),
          trianglesOf(vertices.same, static_cast<std::size_t>(surface.faceCount()),
                      static_cast<std::size_t>(subdivisions)),
          isClosed(surface)};
}

int subdivisionsForTexels(const LimitSurface& surface, Vec2 texelsPerUv, double mostTriangles) {
  double longestSide = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const LimitPoint middle = surface.evaluate(face, 0.5, 0.5);
    longestSide = std::max({longestSide, glm::length(middle.uvDs * texelsPerUv),
                            glm::length(middle.uvDt * texelsPerUv)});
  }
  const double most = std::sqrt(mostTriangles / triangleCount(surface, 1));
  for (const int perTexel : {4, 2, 1}) {
    const double pieces = std::ceil(perTexel * longestSide - 1e-9);
    if (pieces <= most) return std::max(1, static_cast<int>(pieces));
  }
  return std::max(1, static_cast<int>(most));
}

}  // namespace gnomon
