#include "surface/base_mesh.h"

#include <fmt/format.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "surface/face_grids.h"

namespace gnomon::surface {

namespace {

constexpr int mostSubdivisions = 1024;

/// Turns and swaps the principal directions of one face's vertices to agree with its first vertex
/// that has any.
void alignDirections(std::span<BaseVertex> vertices) {
  const auto first = std::find_if(vertices.begin(), vertices.end(), [](const BaseVertex& vertex) {
    return vertex.curvatures.v1 != Vec3(0);
  });
  if (first == vertices.end()) return;
  const Vec3 v1 = first->curvatures.v1;
  const Vec3 v2 = first->curvatures.v2;
  for (BaseVertex& vertex : vertices) {
    PrincipalCurvatures& own = vertex.curvatures;
    // The better of the two pairings as a whole, since on a bent face both dots may be small.
    const double kept = std::abs(glm::dot(own.v1, v1)) + std::abs(glm::dot(own.v2, v2));
    const double swapped = std::abs(glm::dot(own.v1, v2)) + std::abs(glm::dot(own.v2, v1));
    if (swapped > kept) {
      std::swap(own.v1, own.v2);
      std::swap(own.k1, own.k2);
    }
    if (glm::dot(own.v1, v1) < 0) own.v1 = -own.v1;
    if (glm::dot(own.v2, v2) < 0) own.v2 = -own.v2;
  }
}

/// At a hard edge the vertices on its two sides are kept apart: they have the first vertex with
/// their own normal in the place of the first.
void partByNormals(const BaseMesh& mesh, std::vector<std::uint32_t>& shared) {
  constexpr double sameNormal = 1e-6;
  std::vector<std::vector<std::uint32_t>> kinds(shared.size());  // at each first vertex
  for (std::uint32_t vertex = 0; vertex < shared.size(); ++vertex) {
    std::vector<std::uint32_t>& known = kinds[shared[vertex]];
    const Vec3& normal = mesh.vertices[vertex].frame.normal;
    const auto same = std::find_if(known.begin(), known.end(), [&](std::uint32_t other) {
      return glm::length(mesh.vertices[other].frame.normal - normal) < sameNormal;
    });
    if (same == known.end()) {
      known.push_back(vertex);
      shared[vertex] = vertex;
    } else {
      shared[vertex] = *same;
    }
  }
}

/// Puts estimates in the place of the limit surface's curvatures.
void estimateCurvatures(const LimitSurface& surface, const FaceGrids& grids, BaseMesh& mesh) {
  constexpr double bytesPerVertex = 320;  // the fit, its result and the shared vertex
  requireMemory(bytesPerVertex * static_cast<double>(mesh.vertices.size()),
                fmt::format("curvature estimates of {} vertices", mesh.vertices.size()));
  std::vector<std::uint32_t> shared = firstVertices(surface, grids);
  if (surface.isPolygons()) partByNormals(mesh, shared);
  const auto estimates = estimatedCurvatures(
      mesh, shared, surface.isPolygons() ? EdgeCurvature::ofNormals : EdgeCurvature::ofCircle);
  for (std::size_t i = 0; i < estimates.size(); ++i) mesh.vertices[i].curvatures = estimates[i];
}

void requireSize(const LimitSurface& surface, int subdivisions) {
  if (subdivisions < 1 || subdivisions > mostSubdivisions) {
    throw InputError(fmt::format("{} found, 1 to {} expected", subdivisions, mostSubdivisions),
                     "subdivisions");
  }
  const double lines = subdivisions + 1.0;
  const double vertices = surface.faceCount() * lines * lines;
  const double indices = 6.0 * surface.faceCount() * subdivisions * subdivisions;
  if (vertices > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(fmt::format("{} found, which give {:.0f} vertices: fewer than 2^32 expected",
                                 subdivisions, vertices),
                     "subdivisions");
  }
  requireMemory(vertices * sizeof(BaseVertex) + indices * sizeof(std::uint32_t),
                fmt::format("{}, a base mesh of {:.0f} vertices", subdivisions, vertices),
                "subdivisions");
}

}  // namespace

BaseMesh makeBaseMesh(const LimitSurface& surface, Vec2 texelsPerUv, int subdivisions,
                      CurvatureSource curvature) {
  requireSize(surface, subdivisions);
  const FaceGrids grids = FaceGrids::even(surface.faceCount(), subdivisions);
  BaseMesh mesh;
  mesh.vertices.resize(grids.vertexCount());
  mesh.triangles = gridTriangles(grids, Diagonal::fromOrigin);
  parallelFor(0, grids.faces().size(), [&](std::size_t face) {
    const FaceGrid& grid = grids.faces()[face];
    BaseVertex* vertex = &mesh.vertices[grid.firstVertex];
    for (const double t : grids.tLines(grid)) {
      for (const double s : grids.sLines(grid)) {
        const LimitPoint point = surface.evaluate(static_cast<int>(face), s, t);
        *vertex++ = {texelFrame(point, texelsPerUv), principalCurvatures(point),
                     static_cast<int>(face), Vec2(s, t)};
      }
    }
  });
  if (curvature == CurvatureSource::vertices) estimateCurvatures(surface, grids, mesh);
  for (const FaceGrid& grid : grids.faces()) {
    alignDirections({&mesh.vertices[grid.firstVertex], grid.vertexCount()});
  }
  return mesh;
}

namespace {

using Matrix = glm::dmat3;

/// The normal equations of a vertex's form (l11, l12, l22) in an orthonormal tangent frame.
struct Fit {
  Vec3 e1{0}, e2{0}, normal{0};
  Matrix matrix{0};
  Vec3 right{0};

  explicit Fit(const Vec3& n) : normal(n) {
    if (n == Vec3(0)) return;
    const Vec3 axis = std::abs(n.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    e1 = glm::normalize(glm::cross(axis, n));
    e2 = glm::cross(n, e1);
  }

  /// @param rise  the curvature along the edge times the square of its length
  void addEdge(const Vec3& edge, double rise) {
    const double x = glm::dot(edge, e1);
    const double y = glm::dot(edge, e2);
    const double tangential = std::hypot(x, y);
    const double square = glm::dot(edge, edge);
    if (!(tangential > 0)) return;
    const double c = x / tangential;
    const double s = y / tangential;
    const Vec3 row(c * c, 2 * c * s, s * s);
    matrix += glm::outerProduct(row, row);
    right += rise / square * row;
  }

  [[nodiscard]] PrincipalCurvatures solve() const {
    if (normal == Vec3(0) || matrix == Matrix(0)) return {0, 0, Vec3(0), Vec3(0)};
    // A weight of 1e-9 on (l11 - l22)² + 4 l12² decides what the edges leave open, and changes
    // nothing else.
    const double weight = 1e-9 * (matrix[0][0] + matrix[1][1] + matrix[2][2]);
    const Matrix toUmbilic(1, 0, -1, 0, 4, 0, -1, 0, 1);
    const Vec3 form = glm::inverse(matrix + weight * toUmbilic) * right;
    const double mean = (form.x + form.z) / 2;
    return ShapeOperator{e1, e2, form.x, form.y, form.z}.principal(1e-7 * std::abs(mean));
  }
};

}  // namespace

std::vector<PrincipalCurvatures> estimatedCurvatures(const BaseMesh& mesh,
                                                     std::span<const std::uint32_t> shared,
                                                     EdgeCurvature along) {
  std::vector<Fit> fits;
  fits.reserve(mesh.vertices.size());
  for (const std::uint32_t first : shared) fits.emplace_back(mesh.vertices[first].frame.normal);
  for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
    const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
    const std::uint32_t a = shared[mesh.triangles[corner]];
    const std::uint32_t b = shared[mesh.triangles[next]];
    const Vec3 edge = mesh.vertices[b].frame.position - mesh.vertices[a].frame.position;
    if (along == EdgeCurvature::ofNormals) {
      const double rise = glm::dot(mesh.vertices[mesh.triangles[next]].frame.normal -
                                       mesh.vertices[mesh.triangles[corner]].frame.normal,
                                   edge);
      fits[a].addEdge(edge, rise);
      fits[b].addEdge(-edge, rise);
    } else {
      fits[a].addEdge(edge, -2 * glm::dot(fits[a].normal, edge));
      fits[b].addEdge(-edge, -2 * glm::dot(fits[b].normal, -edge));
    }
  }
  std::vector<PrincipalCurvatures> result(mesh.vertices.size());
  parallelFor(
      0, result.size(), [&](std::size_t i) { result[i] = fits[shared[i]].solve(); }, 1024);
  return result;
}

}  // namespace gnomon::surface
