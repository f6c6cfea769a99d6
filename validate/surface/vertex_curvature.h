#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/base_mesh.h"
#include "surface/curvature.h"

namespace gnomon::surface {

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
/// @returns one entry a vertex
std::vector<PrincipalCurvatures> estimatedCurvatures(const BaseMesh& mesh,
                                                     std::span<const std::uint32_t> shared);

}  // namespace gnomon::surface
