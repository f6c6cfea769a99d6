#pragma once

#include <string>
#include <string_view>

namespace gnomon::report {

/// Text that XML 1.0 can hold, as UTF-8: whatever is no UTF-8 or no XML character (U+FFFE,
/// U+FFFF), a control character other than tab and line breaks, or turns the direction of the text
/// after it, becomes U+FFFD. What XML escapes is left as it is.
std::string xmlText(std::string_view text);

}  // namespace gnomon::report
