#pragma once

#include <map>
#include <string>
#include <variant>

namespace gnomon {

/// What a file's header says beside the pixels, by name.
using ImageAttributes = std::map<std::string, std::variant<int, float, std::string>>;

}  // namespace gnomon
