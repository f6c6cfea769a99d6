#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "relief/relief.h"
#include "surface/limit_surface.h"

namespace gnomon::displaced {

/// The displaced surface for other programs: triangles that share their vertices.
struct WeldedMesh {
  std::vector<glm::vec3> vertices;       ///< world coordinates
  std::vector<std::uint32_t> triangles;  ///< three vertices each, counter-clockwise outside
  bool closed = false;                   ///< every side of a triangle belongs to two triangles

  [[nodiscard]] std::size_t triangleCount() const { return triangles.size() / 3; }
};

/// Every face cut into `subdivisions` × `subdivisions` quadrilaterals of displaced limit points,
/// D = P + a h n, and each of these into two triangles as the truth's micro-mesh is
/// (Diagonal::acrossOrigin). The 2 N² triangles of face f begin at triangle 2 N² f. Faces that meet
/// share the vertices of their edge, so that a closed cage gives a closed mesh; across a texture
/// seam the first face's height rules, as in the micro-mesh.
/// @param subdivisions  1 to 8192
/// @throws InputError for other subdivisions or 2³¹ vertices and more, MemoryError if they cannot
///   fit
WeldedMesh makeWeldedMesh(const surface::LimitSurface& surface, const relief::Relief& relief,
                          int subdivisions);

/// The point of the mesh above (s, t) of a face: on the triangle that holds it, as MicroMesh::facet
/// finds it.
/// @param subdivisions  that the mesh was made with
Vec3 pointOn(const WeldedMesh& mesh, int subdivisions, int face, double s, double t);

/// The subdivisions that give at least 8 pieces a texel along the longest face, measured through
/// its middle, or the most of no more than `mostTriangles`. Where the sides of all faces are whole
/// texels, and such a number is small enough, they are a multiple of twice each side, with 8, 4, 2
/// or 1 pieces a texel: pieces then end on the lines through the texels' centres, at which the
/// relief has its kinks.
int subdivisionsForTexels(const surface::LimitSurface& surface, Vec2 texelsPerUv,
                          double mostTriangles = 4e6);

}  // namespace gnomon::displaced
