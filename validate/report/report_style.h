#pragma once

#include <string_view>

namespace gnomon {

/// The content of report.css.
std::string_view reportStyle();

}  // namespace gnomon
