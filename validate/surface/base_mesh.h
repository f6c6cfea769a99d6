#pragma once

#include <cstdint>
#include <vector>

#include "common/vec.h"
#include "surface/curvature.h"
#include "surface/limit_surface.h"
#include "surface/texel_frame.h"

namespace gnomon::surface {

/// One vertex of the base mesh: what the papers' vertex programs hand to the pixel.
struct BaseVertex {
  TexelFrame frame;                ///< of the limit surface
  PrincipalCurvatures curvatures;  ///< k1 < k2 where they were swapped: see makeBaseMesh
  int face;                        ///< the limit face that it belongs to
  Vec2 st;                         ///< its parameters on that face
};

/// The polygons that a real-time method draws. Vertices are not shared between limit faces, so
/// that (face, s, t) interpolates inside each.
struct BaseMesh {
  std::vector<BaseVertex> vertices;
  std::vector<std::uint32_t> triangles;  ///< three vertices each, counter-clockwise outside

  [[nodiscard]] std::size_t triangleCount() const { return triangles.size() / 3; }
};

/// Where the principal curvatures of a base mesh come from.
enum class CurvatureSource {
  limit,     ///< the limit surface at the vertex
  vertices,  ///< the mesh's own edges and normals: see estimatedCurvatures
};

/// Cuts every face into `subdivisions` × `subdivisions` quadrilaterals and each of these into two
/// triangles (Diagonal::fromOrigin). Principal directions have neither sign nor order; at a face's
/// vertices they are flipped and swapped to agree with the first vertex, so that they can be
/// interpolated, as eq. (1) of Onoue, Max & Nishita 2004 interpolates V₁ and V₂. Where the surface
/// is degenerate, directions and normal are zero.
/// @param texelsPerUv   as in texelFrame
/// @param subdivisions  1 to 1024
/// @throws InputError for other subdivisions or 2³² vertices and more, MemoryError if they cannot
/// fit
BaseMesh makeBaseMesh(const LimitSurface& surface, Vec2 texelsPerUv, int subdivisions,
                      CurvatureSource curvature = CurvatureSource::limit);

}  // namespace gnomon::surface
