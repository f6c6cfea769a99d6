#pragma once

#include <cstdint>
#include <vector>

#include "common/vec.h"
#include "surface/limit_surface.h"

namespace gnomon {

/// One vertex of the base mesh: what the papers' vertex programs hand to the pixel.
struct BaseVertex {
  Vec3 position;
  Vec3 normal;
  Vec3 px, py;    ///< world per texel
  Vec3 v1, v2;    ///< principal directions, world, unit
  double k1, k2;  ///< curvatures along v1 and v2, 1 / world; k1 < k2 where they were swapped
  Vec2 texel;     ///< texture coordinates in texels
  int face;       ///< the limit face it belongs to
  Vec2 st;        ///< its parameters there
};

/// The polygons that a real-time method draws. Vertices are not shared between limit faces, so
/// that (face, s, t) interpolates inside each.
struct BaseMesh {
  std::vector<BaseVertex> vertices;
  std::vector<std::uint32_t>
      triangles;  ///< three vertex indices a triangle, counter-clockwise outside

  [[nodiscard]] std::size_t triangleCount() const { return triangles.size() / 3; }
};

/// Where a base mesh has its principal curvatures from.
enum class CurvatureSource {
  limit,     ///< the limit surface at the vertex
  vertices,  ///< the mesh's own edges and normals: see estimatedCurvatures
};

/// Cuts every face into `subdivisions` × `subdivisions` quadrilaterals and each of these into two
/// triangles along its (0,0)-(1,1) diagonal. Principal directions are lines without a sign or order
/// of their own; those of a face's vertices are turned and swapped to agree with its first vertex,
/// so that interpolation between them means something (eq. (1) of Onoue, Max & Nishita 2004
/// interpolates V₁ and V₂). Where a vertex is degenerate, its directions and normal are zero.
/// @param texelsPerUv   as in texelFrame
/// @param subdivisions  1 to 1024
/// @throws InputError for other subdivisions or 2³² vertices and more, MemoryError if they cannot
/// fit
BaseMesh makeBaseMesh(const LimitSurface& surface, Vec2 texelsPerUv, int subdivisions,
                      CurvatureSource curvature = CurvatureSource::limit);

}  // namespace gnomon
