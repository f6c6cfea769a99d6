#pragma once

#include <string>
#include <vector>

#include "render/gl_handles.h"
#include "render/shader_files.h"

namespace gnomon::render {

/// The stages of a program, each its pieces one after the other.
struct ProgramStages {
  std::vector<ShaderPiece> vertex;
  std::vector<ShaderPiece> geometry;  ///< empty for none
  std::vector<ShaderPiece> fragment;
};

/// Compiles and links a GLSL 4.50 program, every stage below `#version` and one `#define` a name.
/// @throws InputError with file and line of the first error that the compiler names
gl::Program makeProgram(const ProgramStages& stages, const std::vector<std::string>& defines);

}  // namespace gnomon::render
