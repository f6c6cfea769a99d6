#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/vec.h"
#include "surface/curvature.h"
#include "surface/limit_surface.h"
#include "surface/texel_frame.h"

namespace gnomon::surface {

/// One vertex of the base mesh: what the papers' vertex programs hand to the pixel.
struct BaseVertex {
  TexelFrame frame;                ///< of the surface
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
  limit,     ///< the limit surface at the vertex; of polygons, which have none, as curvature.h says
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

/// The curvature along an edge d of a mesh.
enum class EdgeCurvature {
  ofCircle,  ///< -2 n·d / d²: of the circle through both ends
  ofNormals,  ///< (n₂ - n₁)·d / d²: by the normals at both ends (Rusinkiewicz 2004). On a sphere
              ///< the same; and the same however often a flat polygon is cut, between whose corners
              ///< the circle would be flat or twice as sharp
};

/// Principal curvatures at the vertices of a polygon mesh from the mesh alone, as for a program
/// that has polygons and normals but no limit surface. Along an edge d from a vertex with normal n
/// the circle through both ends and tangent at the vertex has the curvature -2 n·d / d² (convex
/// positive); the second fundamental form is the one that fits those of all edges about the vertex
/// best, by least squares in which an edge counts once for each of its triangles. Exact on spheres
/// and circular cylinders, whatever the mesh; elsewhere it errs with the edges' length.
///
/// Where the edges do not determine the form (fewer than three directions), the form with the least
/// difference of curvatures is taken. Zero at a vertex without a normal.
/// @param shared  for each vertex the first vertex at the same place (see firstVertices): their
///   edges are taken together, with the normal of the first
/// @param along   what an edge's curvature is; on polygons `ofNormals`
/// @returns one entry a vertex
std::vector<PrincipalCurvatures> estimatedCurvatures(const BaseMesh& mesh,
                                                     std::span<const std::uint32_t> shared,
                                                     EdgeCurvature along = EdgeCurvature::ofCircle);

}  // namespace gnomon::surface
