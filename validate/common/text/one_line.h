#pragma once

#include <string>
#include <string_view>

namespace gnomon {

/// The text as one line of UTF-8 that shows what it holds: a message of another library, a piece of
/// a file or a name, as part of a message or a table. Control characters and ends of lines become
/// spaces; bytes that are no UTF-8, and characters that turn the direction of what follows, U+FFFD.
std::string oneLine(std::string_view text);

}  // namespace gnomon
