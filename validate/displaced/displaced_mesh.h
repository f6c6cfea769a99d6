#pragma once

#include <cstdint>
#include <vector>

#include "relief/relief.h"
#include "surface/base_mesh.h"
#include "surface/limit_surface.h"

namespace gnomon::displaced {

/// The displaced surface at a polygon count for drawing, not for ray tracing, as the mesh of Figure
/// 8(c) of Onoue, Max & Nishita 2004.
struct DisplacedMesh {
  /// Positions are displaced, D = P + a h n; everything else belongs to the undisplaced surface, as
  /// face and (s, t) do. Vertices are not shared between faces, but coincide to the bit where faces
  /// meet.
  surface::BaseMesh mesh;
  std::vector<std::uint32_t> adjacency;  ///< see triangleAdjacency
};

/// Six vertices a triangle, as GL_TRIANGLES_ADJACENCY takes them: its corners a, b, c, and behind
/// each its edge's opposite vertex in the neighbour: a, ab, b, bc, c, ca. An edge without a
/// neighbour has the triangle's own third corner there: the triangle seen from behind.
/// @param shared  for each vertex the first vertex at the same place, see firstVertices
std::vector<std::uint32_t> triangleAdjacency(const surface::BaseMesh& mesh,
                                             const std::vector<std::uint32_t>& shared);

/// Every face cut into `subdivisions` × `subdivisions` quadrilaterals as makeBaseMesh does, each
/// vertex displaced by the relief. Across a texture seam, where the heights of the two sides
/// differ, the first face's height rules the common edge, as in the micro-mesh.
/// @throws as makeBaseMesh
DisplacedMesh makeDisplacedMesh(const surface::LimitSurface& surface, const relief::Relief& relief,
                                int subdivisions);

}  // namespace gnomon::displaced
