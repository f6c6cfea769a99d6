#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::report {

/// Text for a terminal, measured in its columns: a wide character takes two, a combining one none.
/// Control characters become '?'; bytes that are not UTF-8, and characters that turn the direction
/// of the text after them, U+FFFD: no label can move the cursor or make a row read as another. Line
/// breaks count as control characters.

/// The columns that `text` takes.
std::size_t displayWidth(std::string_view text);

/// The text on one line, as it is.
std::string terminalText(std::string_view text);

/// The text, padded with spaces or cut (then it ends in "…") to exactly `width` columns.
std::string fitLeft(std::string_view text, std::size_t width);

/// As fitLeft, but the text stands at the right.
std::string fitRight(std::string_view text, std::size_t width);

/// The text broken at spaces into lines of at most `width` columns (≥ 1); a longer word is cut into
/// pieces. No text gives no line.
std::vector<std::string> wrapText(std::string_view text, std::size_t width);

/// Text that XML 1.0 can hold, as UTF-8: whatever is no UTF-8 or no XML character (U+FFFE,
/// U+FFFF), a control character other than tab and line breaks, or turns the direction of the text
/// after it, becomes U+FFFD. What XML escapes is left as it is.
std::string xmlText(std::string_view text);

}  // namespace gnomon::report
