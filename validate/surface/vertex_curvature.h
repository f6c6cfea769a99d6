#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/base_mesh.h"
#include "surface/curvature.h"

namespace gnomon {

/// Principal curvatures at the vertices of a polygon mesh from the mesh alone: what a program has
/// that is given polygons and normals, and no limit surface. Along an edge d from a vertex with
/// normal n the circle through both ends and tangent at the vertex has the curvature -2 n·d / d²
/// (convex positive); the second fundamental form is the one that fits those of all edges about
/// the vertex best, by least squares in which an edge counts once for each of its triangles. Exact
/// on spheres and circular cylinders, whatever the mesh; elsewhere it errs with the edges' length.
///
/// Where the edges leave a form open (fewer than three directions), that of the two curvatures most
/// alike is taken. Zero at a vertex without a normal.
/// @param shared  for each vertex the first one that coincides with it (itself, if none does):
///   their edges are taken together, with that one's normal
/// @returns one entry a vertex
std::vector<PrincipalCurvatures> estimatedCurvatures(const BaseMesh& mesh,
                                                     std::span<const std::uint32_t> shared);

}  // namespace gnomon
