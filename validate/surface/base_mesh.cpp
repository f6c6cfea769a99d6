#include "surface/base_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "surface/curvature.h"
#include "surface/shared_vertices.h"
#include "surface/texel_frame.h"
#include "surface/vertex_curvature.h"

namespace gnomon {
namespace {

constexpr int mostSubdivisions = 1024;

BaseVertex makeVertex(const LimitSurface& surface, Vec2 texelsPerUv, int face, Vec2 st) {
  const LimitPoint point = surface.evaluate(face, st.x, st.y);
  const TexelFrame frame = texelFrame(point, texelsPerUv);
  const PrincipalCurvatures principal = principalCurvatures(point);
  return {point.position,
          outwardNormal(point),
          frame.px,
          frame.py,
          principal.v1,
          principal.v2,
          principal.k1,
          principal.k2,
          frame.texel,
          face,
          st};
}

/// Turns and swaps the principal directions of one face's vertices to agree with its first vertex
/// that has any.
void alignDirections(std::span<BaseVertex> vertices) {
  const auto first = std::find_if(vertices.begin(), vertices.end(),
                                  [](const BaseVertex& vertex) { return vertex.v1 != Vec3(0); });
  if (first == vertices.end()) return;
  const Vec3 v1 = first->v1;
  const Vec3 v2 = first->v2;
  for (BaseVertex& vertex : vertices) {
    // The better of the two pairings as a whole, since on a bent face both dots may be small.
    const double kept = std::abs(glm::dot(vertex.v1, v1)) + std::abs(glm::dot(vertex.v2, v2));
    const double swapped = std::abs(glm::dot(vertex.v1, v2)) + std::abs(glm::dot(vertex.v2, v1));
    if (swapped > kept) {
      std::swap(vertex.v1, vertex.v2);
      std::swap(vertex.k1, vertex.k2);
    }
    if (glm::dot(vertex.v1, v1) < 0) vertex.v1 = -vertex.v1;
    if (glm::dot(vertex.v2, v2) < 0) vertex.v2 = -vertex.v2;
  }
}

void writeTriangles(std::span<std::uint32_t> triangles, std::size_t firstVertex,
                    std::size_t subdivisions) {
  std::size_t next = 0;
  for (std::size_t row = 0; row < subdivisions; ++row) {
    for (std::size_t column = 0; column < subdivisions; ++column) {
      const std::size_t a = firstVertex + row * (subdivisions + 1) + column;
      const std::size_t b = a + 1;
      const std::size_t d = a + subdivisions + 1;
      const std::size_t c = d + 1;
      for (const std::size_t corner : {a, b, c, a, c, d}) {
        triangles[next++] = static_cast<std::uint32_t>(corner);
      }
    }
  }
}

/// Puts estimates in the place of the limit surface's curvatures.
void estimateCurvatures(const LimitSurface& surface, int subdivisions, BaseMesh& mesh) {
  constexpr double bytesPerVertex = 320;  // the fit, its result and the shared vertex
  requireMemory(bytesPerVertex * static_cast<double>(mesh.vertices.size()),
                fmt::format("curvature estimates of {} vertices", mesh.vertices.size()));
  std::vector<std::uint32_t> shared(mesh.vertices.size());
  std::iota(shared.begin(), shared.end(), 0U);
  const int lines = subdivisions + 1;
  forEachSharedVertex(
      surface,
      [lines](std::size_t face) {
        return FaceGrid{static_cast<std::uint32_t>(face) * static_cast<std::uint32_t>(lines) *
                            static_cast<std::uint32_t>(lines),
                        lines, lines};
      },
      [&](std::size_t first, std::size_t vertex) {
        shared[vertex] = static_cast<std::uint32_t>(first);
      });
  const std::vector<PrincipalCurvatures> estimates = estimatedCurvatures(mesh, shared);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    BaseVertex& vertex = mesh.vertices[i];
    vertex.k1 = estimates[i].k1;
    vertex.k2 = estimates[i].k2;
    vertex.v1 = estimates[i].v1;
    vertex.v2 = estimates[i].v2;
  }
}

void requireSize(const LimitSurface& surface, int subdivisions) {
  if (subdivisions < 1 || subdivisions > mostSubdivisions) {
    throw InputError(
        fmt::format("base.subdivisions is {}, expected 1 to {}", subdivisions, mostSubdivisions));
  }
  const double lines = subdivisions + 1.0;
  const double vertices = surface.faceCount() * lines * lines;
  const double indices = 6.0 * surface.faceCount() * subdivisions * subdivisions;
  const std::string what = fmt::format("base mesh of {} faces at base.subdivisions {}",
                                       surface.faceCount(), subdivisions);
  if (vertices > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(fmt::format("{}: {} vertices, expected fewer than 2^32", what, vertices));
  }
  requireMemory(vertices * sizeof(BaseVertex) + indices * sizeof(std::uint32_t), what);
}

}  // namespace

BaseMesh makeBaseMesh(const LimitSurface& surface, Vec2 texelsPerUv, int subdivisions,
                      CurvatureSource curvature) {
  requireSize(surface, subdivisions);
  const auto faces = static_cast<std::size_t>(surface.faceCount());
  const auto cuts = static_cast<std::size_t>(subdivisions);
  const std::size_t perFace = (cuts + 1) * (cuts + 1);
  const std::size_t indicesPerFace = 6 * cuts * cuts;
  BaseMesh mesh;
  mesh.vertices.resize(faces * perFace);
  mesh.triangles.resize(faces * indicesPerFace);
  parallelFor(0, faces, [&](std::size_t face) {
    const std::span vertices(mesh.vertices.data() + face * perFace, perFace);
    for (std::size_t i = 0; i < perFace; ++i) {
      const std::size_t column = i % (cuts + 1);
      const std::size_t row = i / (cuts + 1);
      const Vec2 st = Vec2(column, row) / static_cast<double>(subdivisions);
      vertices[i] = makeVertex(surface, texelsPerUv, static_cast<int>(face), st);
    }
    writeTriangles({mesh.triangles.data() + face * indicesPerFace, indicesPerFace}, face * perFace,
                   cuts);
  });
  if (curvature == CurvatureSource::vertices) estimateCurvatures(surface, subdivisions, mesh);
  parallelFor(0, faces, [&](std::size_t face) {
    alignDirections({mesh.vertices.data() + face * perFace, perFace});
  });
  return mesh;
}

}  // namespace gnomon
