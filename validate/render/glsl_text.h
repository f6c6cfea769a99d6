#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/shader_files.h"

namespace gnomon::render {

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

}  // namespace gnomon::render
