#pragma once

#include "report/text/html.h"

namespace gnomon::report {

/// The parts of a report page that are written in their own languages, in the folder `page`.

/// The style of all pages.
Html pageStyle();

/// The comparison of two pictures, hidden until the script runs.
Html viewerMarkup();

/// The script that drives it.
Html viewerScript();

/// The script's SHA-256 as a content policy names it: 'sha256-…'.
Html viewerScriptHash();

}  // namespace gnomon::report
