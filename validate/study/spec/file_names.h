#pragma once

#include <set>
#include <string>
#include <vector>

namespace gnomon {

/// Whether a study's name may hold a character, since it names a folder: letters, digits, `-`, `_`,
/// `.`.
bool isNameCharacter(char c);

/// Names as parts of file names: at most some sixty letters, digits, dots and dashes, distinct for
/// distinct indices.
/// @param taken  parts that none of them may become
std::vector<std::string> fileNames(const std::vector<std::string>& names,
                                   std::set<std::string> taken = {});

}  // namespace gnomon
