#pragma once

#include <string>
#include <vector>

namespace gnomon {

/// One line of a CSV file, quoted as RFC 4180 says, ended by LF.
std::string csvLine(const std::vector<std::string>& cells);

}  // namespace gnomon
