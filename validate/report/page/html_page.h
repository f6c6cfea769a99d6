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

/// A plot inside the page: drawn for wide screens and, where there is such a drawing, for narrow
/// ones, with its legend, in which a reader highlights methods, and its values as a table.
Html htmlPlot(const DrawnPlot& plot);

/// How the plots of a page are read: what their colours mean and what a reader can do.
constexpr std::string_view plotReading =
    "A colour stands for a family of methods, a symbol for a method; both are the same in every "
    "report. At most eight methods are highlighted: the flat horizon map, the method of the first "
    "claim, and the best others. The rest are grey. Press a name below a plot to highlight it or "
    "not. Point at a symbol, or use the arrow keys, to read its value.";

/// The shapes that the plots of a page are drawn with, once a page; nothing without a plot.
Html htmlSymbols(std::span<const DrawnPlot> plots);

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

}  // namespace gnomon::report
