#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace gnomon {

/// The name that a mistyped one was probably meant to be: the nearest by the number of letters that
/// are missing, too many, wrong, or swapped with their neighbour (Damerau 1964), in at most a
/// third of its letters; or else the shortest that begins with the typed one's three letters or
/// more.
std::optional<std::string> nearestName(std::string_view typed,
                                       const std::set<std::string, std::less<>>& names);

/// The text as one line of UTF-8 that shows what it holds: a message of another library, a piece of
/// a file or a name, as part of a message or a table. Control characters and ends of lines become
/// spaces; bytes that are no UTF-8, and characters that change the direction of what follows,
/// U+FFFD.
std::string oneLine(std::string_view text);

/// A word as a POSIX shell reads it back: itself if it holds nothing but letters, digits and
/// `_ @ % + = : , . / -`, else in single quotes, with every single quote as `'\''`.
std::string shellQuoted(std::string_view word);

/// A character of UTF-8, and the bytes that it took.
struct Utf8Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool valid = false;  ///< false for a byte that begins no character: code 0, 1 byte
};

/// The first character of a text that is not empty.
Utf8Character firstCharacter(std::string_view text);

/// Whether all of a text is UTF-8.
bool isUtf8(std::string_view text);

/// Whether a character is a control character or ends a line: C0, DEL, C1, U+2028 and U+2029.
bool isControl(std::uint32_t code);

/// Whether a character changes the direction of the text after it (Unicode's embeddings, overrides
/// and isolates): it could make one word of a line read as another.
bool reversesText(std::uint32_t code);

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
