#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon {

/// The folder that holds `common/` and `methods/`: the environment's GNOMON_SHADERS, else beside
/// the installed program (../share/gnomon/shaders), else the source tree that the program was built
/// from.
/// @throws InputError if none of them is there
std::filesystem::path shaderFolder();

/// A piece of a shader: text, and the file that errors in it are reported for.
struct ShaderPiece {
  std::string file;
  std::string text;
};

/// Reads a shader file as one piece.
ShaderPiece readShader(const std::filesystem::path& path);

}  // namespace gnomon
