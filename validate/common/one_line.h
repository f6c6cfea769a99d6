#pragma once

#include <string>
#include <string_view>

namespace gnomon {

/// The text with a space in the place of every control character: a message of another library, or
/// a piece of a file, as part of a message of one line.
std::string oneLine(std::string_view text);

}  // namespace gnomon
