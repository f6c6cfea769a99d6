#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace gnomon::render {

// What the text of a shader says without a compiler.

/// The line of a word of the code, without comments.
std::optional<std::size_t> lineOfWord(std::string_view glsl, std::string_view word);

/// Whether the code defines a function by this name: outside all braces, followed by parentheses
/// that hold the word `argument`. Local variables may have the same name.
bool definesFunction(std::string_view glsl, std::string_view name, std::string_view argument);

}  // namespace gnomon::render
