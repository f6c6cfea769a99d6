#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
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

// What the text of a shader says without a compiler.

/// The line of a word of the code, without comments.
std::optional<std::size_t> lineOfWord(std::string_view glsl, std::string_view word);

/// Whether the code defines a function by this name: outside all braces, followed by parentheses
/// that hold the word `argument`. Local variables may have the same name.
bool definesFunction(std::string_view glsl, std::string_view name, std::string_view argument);

/// The same of code in several pieces.
bool definesFunction(const std::vector<ShaderPiece>& code, std::string_view name,
                     std::string_view argument);

/// "FILE:LINE" of a word of code in several pieces, without comments.
std::optional<std::string> placeOfWord(const std::vector<ShaderPiece>& code, std::string_view word);

/// The code with every loop left where a function `bool nextTurn()`, asked once a turn, says no.
std::string withEndingLoops(std::string_view glsl);

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
