#pragma once

#include <string>
#include <vector>

namespace gnomon {

/// One line of a CSV file, quoted as RFC 4180 says, ended by LF. A cell that begins with = + - @
/// (of full width too), a tab or CR, and is no number, gets an apostrophe before it: spreadsheets
/// would take it for a formula. What `xmlText` refuses becomes U+FFFD.
std::string csvLine(const std::vector<std::string>& cells);

}  // namespace gnomon
