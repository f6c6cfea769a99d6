#pragma once

#include <set>
#include <string>
#include <vector>

namespace gnomon {

/// Names as parts of file names: at most some sixty letters, digits, dots and dashes, distinct for
/// distinct indices.
/// @param taken  parts that none of them may become
std::vector<std::string> fileNames(const std::vector<std::string>& names,
                                   std::set<std::string> taken = {});

}  // namespace gnomon
