#pragma once

#include <filesystem>

#include "surface/cage.h"

namespace gnomon {

/// Reads a Wavefront OBJ as a Catmull-Clark cage: all groups and objects joined, n-gons kept,
/// face-varying texture coordinates, and the tags `t crease` and `t corner` that OpenSubdiv's own
/// files use. A cage with any face that is not a quadrilateral is refined once, so that every face
/// of the result is one; the limit surface is the same.
/// @throws InputError naming file and line or face: unreadable, no faces, index out of range,
///   non-finite or missing texture coordinates, an edge with more than two faces or traversed twice
///   in the same direction, faces with repeated vertices
Cage readObj(const std::filesystem::path& path);

}  // namespace gnomon
