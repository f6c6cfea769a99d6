#pragma once

#include <string>
#include <string_view>

namespace gnomon {

/// Text that stands for itself in HTML, in an element or in a quoted attribute: & < > " ' are
/// escaped, and what `xmlText` refuses becomes U+FFFD.
std::string escapeHtml(std::string_view text);

/// A table inside a box that scrolls sideways where the screen is narrow.
/// @param head  the cells of the head row, as HTML
/// @param body  whole rows, as HTML
std::string htmlTable(std::string_view kind, std::string_view head, std::string_view body);

}  // namespace gnomon
