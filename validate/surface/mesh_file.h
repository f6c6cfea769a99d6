#pragma once

#include <filesystem>
#include <string>

#include "surface/cage/cage.h"

namespace gnomon::surface {

/// Reads a mesh file as a control cage: by the format of the name's ending, `.obj` or `.ply` in
/// either case, then toCage: one rule for joining, parts and checks, whatever the format.
/// @throws InputError for another ending, for a file that holds something else than its name says
///   (compressed, UTF-16, another format of meshes), and as they do
Cage readMeshFile(const std::filesystem::path& file,
                  SubdivisionScheme scheme = SubdivisionScheme::catmullClark);

/// What each scheme would make of a mesh file: "12 triangles: catmull-clark would round them …;
/// none keeps them".
/// @throws InputError as readMeshFile, for what is no mesh
std::string schemeChoice(const std::filesystem::path& path);

}  // namespace gnomon::surface
