#pragma once

#include <filesystem>
#include <string>

#include "displaced/welded_mesh.h"
#include "surface/base_mesh.h"

namespace gnomon::exporting {

/// Writes the triangles as a binary PLY (in this machine's byte order, which the header states):
/// `float x y z` a vertex, `uchar int int int` a face. Whole or not at all.
/// @throws InputError when the file cannot be written
void writePly(const std::filesystem::path& path, const displaced::WeldedMesh& mesh,
              const std::string& comment);

/// Writes the triangles as a Wavefront OBJ, each vertex with its own `vt` (uv) and `vn`, in floats
/// as the rasteriser gets them, with every digit. Whole or not at all.
/// @param texelsPerUv  as in texelFrame
/// @throws InputError when the file cannot be written
void writeObj(const std::filesystem::path& path, const surface::BaseMesh& mesh, Vec2 texelsPerUv,
              const std::string& comment);

}  // namespace gnomon::exporting
