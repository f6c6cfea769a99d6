#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "study/record/record.h"

namespace gnomon {

/// Parts that the pages of a run share, as HTML.

/// All before the body: the style is inside, and the page's own content policy forbids it to load
/// anything but pictures that it holds.
/// @param title  as text
/// @param script  the hash of a script that it may run; of none, if empty
std::string htmlHead(std::string_view title, std::string_view script = "");

/// A section with its heading; nothing, if it has no content.
/// @param title  as HTML
std::string htmlSection(std::string_view id, std::string_view title, const std::string& content);

/// A plot inside the page.
/// @param svg  the document
/// @param alt  what it shows, as text
std::string htmlPlot(const std::string& svg, std::string_view alt);

/// A term and what it is, for a list <dl>; nothing, if there is no text.
std::string htmlFact(std::string_view term, std::string_view text);

/// "1 method", "2 methods".
std::string plural(std::size_t count, std::string_view noun);

/// One claim with its verdict, for the list of a section of claims.
/// @param study  whose claim it is, as HTML; empty where that is clear
std::string htmlClaim(const ClaimRecord& claim, std::string_view study = "");

/// What is to be read before the figures, a paragraph each.
std::string htmlNotices(const std::vector<std::string>& notices);

/// A section of claims with their verdicts; nothing, if there are none.
std::string htmlClaims(const std::vector<ClaimRecord>& claims);

}  // namespace gnomon
