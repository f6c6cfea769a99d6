#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "render/shader_files.h"

namespace gnomon::render {

/// The code of a file with what it includes.
struct IncludedCode {
  std::vector<ShaderPiece> pieces;    ///< one after the other
  std::vector<ShaderPiece> includes;  ///< the files that are included, whole, each once
};

/// Puts files in the place of `#include "FILE"`, a line of its own. FILE lies in the folder of the
/// file that names it or below the folder of the first one, and is included once, where it is first
/// named.
/// @param path  of the file; its errors name `file.file`
/// @throws InputError naming file and line for an include that is malformed, missing, outside the
///   folder, or in itself; and where all of them are longer than a shader may be
IncludedCode expandIncludes(const std::filesystem::path& path, const ShaderPiece& file);

/// No shader that a person wrote is longer; drivers crash on some that are. Bytes.
constexpr std::uintmax_t mostShaderBytes = 1 << 18;

}  // namespace gnomon::render
