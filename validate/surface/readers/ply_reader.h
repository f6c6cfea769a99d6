#pragma once

#include <string>
#include <string_view>

#include "surface/readers/polygon_mesh.h"

// Shared by the sources of this component; no other component includes it.

namespace gnomon::surface {

/// Reads the bytes of a PLY (Turk 1994): ASCII, or binary of either byte order; polygons of any
/// size. It takes
/// - of `vertex`: x, y, z, and where they are there texture coordinates: u, v, or s, t, or
///   texture_u, texture_v; and where they are asked for and are there, normals: nx, ny, nz;
/// - of `face`: the list vertex_indices, or vertex_index, and where it is there the list texcoord:
///   u and v of each corner. It rules over the vertices' own. Empty for a face, that face has none:
///   there are no frames on it.
///
/// All other elements and properties are skipped, sharp edges among them.
/// @param source       the file, as messages name it
/// @param withNormals  reads normals too, which are else not looked at
/// @throws InputError naming file and line, or in a binary file element, row and byte: a header
/// that
///   readPlyHeader refuses, no vertices or faces with these properties, a file that ends early or
///   goes on after its last row, a value that is malformed, out of its type's range or not finite,
///   a texcoord that has not two values for each corner
PolygonMesh readPly(const std::string& source, std::string_view bytes, bool withNormals = false);

}  // namespace gnomon::surface
