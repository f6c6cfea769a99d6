#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::render {

/// The folder that holds `common/` and `methods/`: the environment's GNOMON_SHADERS, else the
/// `share/gnomon/shaders` that is installed with this code, or that its build links to its sources.
/// @throws InputError if neither is there, or the chosen one lacks a folder
std::filesystem::path shaderFolder();

/// Whether an entry of a folder is a shader: a regular file that ends in .glsl, .vert, .geom or
/// .frag. What editors and file managers leave beside them (`.a.glsl.swp`, `a.glsl~`, `#a.glsl#`,
/// `.#a.glsl`, `.DS_Store`) is none.
bool isShader(const std::filesystem::directory_entry& entry);

/// The shaders of a folder, sorted by name.
/// @throws InputError for a folder that cannot be read
std::vector<std::filesystem::path> shadersIn(const std::filesystem::path& folder);

/// A piece of a shader: text, and the file that errors in it are reported for.
struct ShaderPiece {
  std::string file;
  std::string text;
  std::size_t firstLine = 1;  ///< of the text, in the file
};

/// Reads a shader file as one piece.
ShaderPiece readShader(const std::filesystem::path& path);

}  // namespace gnomon::render
