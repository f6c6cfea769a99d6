#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/vec.h"
#include "surface/cage/cage.h"

namespace gnomon::surface {

/// Polygons as they are, scheme `none`, as a cage whose faces are all squares of parameters.
///
/// *Faces.* A quadrilateral whose corners all turn outward is one face, on which everything is
/// bilinear. A triangle counts as three faces, one a corner, as on a Loop cage (see LimitSurface),
/// and all is linear on it. Any other polygon is first cut into triangles, in the plane of its area
/// vector: as long as more than three corners are left, of the corners that turn outward and whose
/// triangle with both neighbours holds no other corner, the one with the shortest diagonal is cut
/// off, the first in the file's order of several. Concave polygons stay what they are (Meisters
/// 1975: there always is such a corner, unless the polygon crosses itself). Where a mesh has
/// triangles *and* quadrilaterals, every quadrilateral is four faces, so that neighbours share
/// whole edges.
///
/// *Normals of shading.* A corner has the file's own normal, of length 1. Where it has none, its
/// vertex's place has one: the mean of the polygons' normals at all corners there, weighted by the
/// corners' angles (Thürmer & Wüthrich 1998).
///
/// *Directions of displacement.* One for each place, whatever polygons meet there: the mean of the
/// normals of shading at all corners there, weighted by the corners' angles. So the displaced
/// surface has no crack at a hard edge, where the normals of shading differ.
///
/// Both are interpolated as positions are and then made unit vectors.
///
/// Any number of polygons may meet at an edge. Only two that run along it in opposite directions
/// continue each other; at any other edge the surface ends.
/// @param polygons   their scheme is taken for `none`; normals may be of any length
/// @param faceParts  of every polygon; empty for one part
/// @throws InputError as requirePolygons; for a normal's index out of range; for a polygon of more
///   than 4096 corners
/// @throws MemoryError if it cannot fit
Cage makePolygonCage(const Polygons& polygons, const PartNames& names,
                     std::span<const int> faceParts = {});

/// For each vertex the first in the very same place.
std::vector<int> firstInPlace(std::span<const Vec3> positions);

/// Cuts a polygon into triangles by the rule of makePolygonCage.
/// @param corners  at least three, in their order
/// @returns  three indices into `corners` for each triangle, in the polygon's order
std::vector<std::array<int, 3>> cutIntoTriangles(std::span<const Vec3> corners);

}  // namespace gnomon::surface
