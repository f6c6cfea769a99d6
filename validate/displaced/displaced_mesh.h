#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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

}  // namespace gnomon::displaced
