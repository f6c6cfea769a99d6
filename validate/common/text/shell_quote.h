#pragma once

#include <string>
#include <string_view>

namespace gnomon {

/// A word as a POSIX shell reads it back: itself if it holds nothing but letters, digits and
/// `_ @ % + = : , . / -`, else in single quotes, with every single quote as `'\''`.
std::string shellQuoted(std::string_view word);

}  // namespace gnomon
