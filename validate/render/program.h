#pragma once

#include <string>
#include <vector>

#include "render/gl_objects.h"
#include "render/method.h"
#include "render/shader_files.h"
#include "render/shared_names.h"

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

/// What the GLSL compiler says of a method, `FILE:LINE: error: …`, made to help its author:
/// - it begins with a file and line of the method. A file that the method includes is followed by
///   the line that includes it; an error in the program's own shaders by its place there, after the
///   line that has the name at fault, or the method's last line where no name is known;
/// - where the compiler misses a name, the end says which declaration provides it, `; to use
///   heightAt, declare tables = ["height"]`; else the nearest name there is, `; did you mean
///   heightAt?`, or the structure that has a member of this name;
/// - where a call or a member does not fit, the end says what does: `; the signature is float
///   heightAt(vec2 at)`.
/// @param names    all that the method may use: of the shared shaders and of its declaration
/// @param defines  that it was compiled with
std::string explainedError(const std::string& message, const Method& method,
                           std::vector<SharedName> names, const std::vector<std::string>& defines);

}  // namespace gnomon::render
