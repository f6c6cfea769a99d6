#pragma once

#include <filesystem>

#include "surface/cage/cage.h"

namespace gnomon::surface {

/// Reads a control cage by readObj or readPly, chosen by the file's extension: `.obj` or `.ply`, in
/// either case.
/// @throws InputError for another ending, and as they do
Cage readMeshFile(const std::filesystem::path& path,
                  SubdivisionScheme scheme = SubdivisionScheme::catmullClark);

}  // namespace gnomon::surface
