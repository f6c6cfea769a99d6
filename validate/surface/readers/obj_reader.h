#pragma once

#include <string>
#include <string_view>

#include "surface/readers/polygon_mesh.h"

// Shared by the sources of this component; no other component includes it.

namespace gnomon::surface {

/// Reads the text of a Wavefront OBJ: n-gons, face-varying texture coordinates, and the tags `t
/// crease` and `t corner` that OpenSubdiv's own files use (vertices counted from 0). Faces are
/// named by the objects (`o`) of a file that has any, else by its groups (`g`, the first name of a
/// line); "unnamed" before the first. A line of numbers may go on in the next, by a \\ at its end.
/// Borders are edgesAndCorners, whatever the file's `t interpolateboundary` says; any other tag is
/// an error, since it would change the surface.
/// @param source       the file, as messages name it
/// @param withNormals  reads `vn` too, which is else not looked at
/// @throws InputError naming file and line: an index that is 0 or counts back too far, a number
/// that
///   is malformed or not finite, texture coordinates at some corners of a face only, a face of
///   fewer than 3 or more than 255 corners
PolygonMesh readObj(const std::string& source, std::string_view text, bool withNormals = false);

}  // namespace gnomon::surface
