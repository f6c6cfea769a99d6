#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/plots/drawn_plots.h"
#include "report/text/html.h"
#include "study/record/gate.h"
#include "study/record/record.h"

namespace gnomon::report {

/// Parts that the pages of a run share.

/// A whole page, at its end the terms that it uses. Its style is inside, and its own content policy
/// forbids it to load anything but pictures that it holds.
/// @param script  its hash is in the policy, so that it alone may run; none, if empty
Html htmlPage(std::string_view title, const Html& header, const Html& main,
              const Html& script = {});

/// A section with its heading; nothing, if it has no content.
Html htmlSection(std::string_view id, const Html& title, const Html& content);
Html htmlSection(std::string_view id, std::string_view title, const Html& content);

/// A paragraph in small letters; nothing, if there is no text.
Html htmlNote(std::string_view text);

/// A plot as gnuplot has drawn it.
Html htmlPlot(const DrawnPlot& plot);

/// The plots of a section of a page, each under its title.
Html htmlPlots(std::span<const DrawnPlot> plots, std::string_view section);

/// Which methods the plots of a page show, and what their colours mean.
constexpr std::string_view plotReading =
    "A plot shows at most eight methods: the flat horizon map, the method of the first claim, and "
    "the best others by error, of a method with several entries the best one first. A colour "
    "stands "
    "for a family of methods, a symbol for a method; both are the same in every report.";

/// A term and what it is, for a list <dl>; nothing, if there is no text.
Html htmlFact(std::string_view term, std::string_view text);

/// "1 method", "2 methods".
std::string plural(std::size_t count, std::string_view noun);

/// The tag that names the status of a run.
Html htmlStatus(study::RunStatus status);

/// One claim with its verdict, for the list of a section of claims.
/// @param study  whose claim it is; empty where that is clear
Html htmlClaim(const study::ClaimRecord& claim, const Html& study = {});

/// A section of claims as htmlClaim makes them; nothing, if there are none.
Html htmlClaims(const Html& claims);

/// The notices that stand before the figures, a paragraph each.
Html htmlNotices(const std::vector<std::string>& notices);

/// How a run is done again: its command, and facts about it.
Html htmlReproduction(std::string_view command, const Html& facts = {});

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
