#pragma once

#include <filesystem>

#include "surface/cage/cage.h"

namespace gnomon::surface {

/// More are too many to report the shadows of each on each.
constexpr std::size_t mostParts = 8;

/// Reads a Wavefront OBJ as a control cage: n-gons kept, all groups and
/// objects joined in one cage, whose parts they are: the objects (`o`) of a file that has any, else
/// its groups (`g`, the first name of a line); "unnamed" before the first. Parts of one name are
/// one. A file with one part, or more than `mostParts`, has none to tell apart. Face-varying
/// texture coordinates, and the tags `t crease` and `t corner` that OpenSubdiv's own files use
/// (vertices counted from 0). Borders are edgesAndCorners, whatever the file's `t
/// interpolateboundary` says; any other tag is an error, since it would change the surface. A
/// Catmull-Clark cage with any face that is not a quadrilateral is refined once, so that every face
/// of the result is one; the limit surface is the same, and texture coordinates are halved
/// linearly. On a face without texture coordinates there are no frames: all its corners get the
/// same coordinate.
/// @throws InputError naming file and line or face: unreadable, no faces, index out of range, a
///   number that is malformed or not finite, texture coordinates at some corners of a face only or
///   at no face at all, a face of more than 255 corners, for Loop's scheme a face that is no
///   triangle, and all that LimitSurface refuses
Cage readObj(const std::filesystem::path& path,
             SubdivisionScheme scheme = SubdivisionScheme::catmullClark);

}  // namespace gnomon::surface
