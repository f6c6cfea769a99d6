#pragma once

#include <string>
#include <vector>

#include "render/gl_handles.h"
#include "render/shader_files.h"

namespace gnomon {

/// Compiles and links a GLSL 4.50 program. Each stage is its pieces one after the other, below
/// `#version` and one `#define` a name.
/// @throws InputError with file and line of the first error that the compiler names
gl::Program makeProgram(const std::vector<ShaderPiece>& vertex,
                        const std::vector<ShaderPiece>& fragment,
                        const std::vector<std::string>& defines);

}  // namespace gnomon
