#pragma once

#include <filesystem>

#include "surface/cage/cage.h"

namespace gnomon::surface {

/// Reads a PLY (Turk 1994) as a control cage: ASCII, or binary of either byte order; polygons of
/// any size. It takes
/// - of `vertex`: x, y, z, and where they are there texture coordinates: u, v, or s, t, or
///   texture_u, texture_v;
/// - of `face`: the list vertex_indices, or vertex_index, and where it is there the list texcoord:
///   u and v of each corner. It rules over the vertices' own. Empty for a face, that face has none:
///   there are no frames on it.
///
/// All other elements and properties are skipped, sharp edges among them. Texture coordinates of
/// vertices cut a mesh apart at its seams: vertices at the very same place are then one. Where
/// faces bring their own, or there are none, vertices stay as they are. Refined as by readObj.
/// @throws InputError naming file and line, or in a binary file element, row and byte: unreadable,
///   a header that readPlyHeader refuses, no vertices or faces with these properties, a file that
///   ends early or goes on after its last row, a value that is malformed, out of its type's range
///   or not finite, a texcoord that has not two values for each corner, no texture coordinates at
///   all, for Loop's scheme a face that is no triangle, and all that LimitSurface refuses
Cage readPly(const std::filesystem::path& path,
             SubdivisionScheme scheme = SubdivisionScheme::catmullClark);

}  // namespace gnomon::surface
