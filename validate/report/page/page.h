#pragma once

#include <string_view>

namespace gnomon {

/// The parts of a report page that are written in their own languages, in the folder `page`.

/// The style of all pages.
std::string_view pageStyle();

/// The comparison of two pictures, hidden until the script runs.
std::string_view viewerMarkup();

/// The script that drives it.
std::string_view viewerScript();

/// The script's SHA-256 as a content policy names it: 'sha256-…'.
std::string_view viewerScriptHash();

}  // namespace gnomon
