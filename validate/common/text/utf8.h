#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gnomon {

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

/// Whether a character turns the direction of the text after it (Unicode's embeddings, overrides
/// and isolates): it could make one word of a line read as another.
bool turnsDirection(std::uint32_t code);

}  // namespace gnomon
