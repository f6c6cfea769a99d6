#include "surface/vertex_curvature.h"

#include <array>
#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "common/parallel.h"

namespace gnomon::surface {
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

  void addEdge(const Vec3& edge) {
    const double x = glm::dot(edge, e1);
    const double y = glm::dot(edge, e2);
    const double tangential = std::hypot(x, y);
    const double square = glm::dot(edge, edge);
    if (!(tangential > 0)) return;
    const double c = x / tangential;
    const double s = y / tangential;
    const Vec3 row(c * c, 2 * c * s, s * s);
    matrix += glm::outerProduct(row, row);
    right += (-2 * glm::dot(normal, edge) / square) * row;
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
                                                     std::span<const std::uint32_t> shared) {
  std::vector<Fit> fits;
  fits.reserve(mesh.vertices.size());
  for (const std::uint32_t first : shared) fits.emplace_back(mesh.vertices[first].frame.normal);
  for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
    const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
    const std::uint32_t a = shared[mesh.triangles[corner]];
    const std::uint32_t b = shared[mesh.triangles[next]];
    const Vec3 edge = mesh.vertices[b].frame.position - mesh.vertices[a].frame.position;
    fits[a].addEdge(edge);
    fits[b].addEdge(-edge);
  }
  std::vector<PrincipalCurvatures> result(mesh.vertices.size());
  parallelFor(
      0, result.size(), [&](std::size_t i) { result[i] = fits[shared[i]].solve(); }, 1024);
  return result;
}

}  // namespace gnomon::surface
