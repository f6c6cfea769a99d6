#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// How deep TOML may nest: so many brackets and braces inside of each other, and so many parts of
/// one dotted key or table header. A study needs no more than five. What nests some ten thousand
/// deep overflows the stack when it is parsed, and when its tables are destroyed; the parser bounds
/// brackets alone.
constexpr int mostTomlNesting = 64;

/// The line, from 1, on which a TOML text first nests deeper than that; none where it does not.
/// Looks at the text alone, before it is parsed: strings and comments are passed over, and text
/// that is no TOML at all is judged by the same rule.
std::optional<int> tooDeepTomlLine(std::string_view text);

/// Refuses a TOML text that nests too deep, before it is parsed.
/// @param file  as messages name it
/// @throws InputError with the line
void requireShallowToml(const std::string& file, std::string_view text);

}  // namespace gnomon
