#pragma once

#include <filesystem>

#include "surface/cage.h"

namespace gnomon {

/// Reads a control cage by the file's ending: `.obj` as readObj does, `.ply` as readPly, in
/// capitals too.
/// @throws InputError for another ending, and as they do
Cage readMeshFile(const std::filesystem::path& path,
                  SubdivisionScheme scheme = SubdivisionScheme::catmullClark);

}  // namespace gnomon
