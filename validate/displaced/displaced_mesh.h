#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "common/progress.h"
#include "relief/relief.h"
#include "surface/base_mesh.h"
#include "surface/face_grids.h"
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

/// Takes the displaced points of some vertices of one row, world, from vertex `first` on.
using PointSink = std::function<void(std::size_t first, std::span<const Vec3> points)>;

/// The displaced limit points D = P + a h n at all vertices of grids, for the micro-mesh that rays
/// are traced on and for the exported mesh. Every vertex is computed by its own face: across a
/// texture seam neighbours differ until one is copied to the other (forEachSharedVertex).
/// @param sink      is called once for each vertex, from several threads at once
/// @param progress  may throw to cancel, see common/progress.h
void displaceGrids(const surface::LimitSurface& surface, const relief::Relief& relief,
                   const surface::FaceGrids& grids, const PointSink& sink,
                   const Progress& progress = {});

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
