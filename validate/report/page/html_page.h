#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/plots/gnuplot.h"
#include "report/tables/table.h"
#include "report/text/html.h"
#include "study/record/gate.h"
#include "study/record/record.h"

namespace gnomon::report {

/// A table for a page: a <table> of its kind's class, inside a box that scrolls sideways where the
/// screen is narrow. What a cell is `about` shows to whoever points at it.
/// @throws InternalError for a number that is not finite
Html htmlTable(const Table& table);

/// An error as a bar, an SVG of its cell's width: false shadow, then false light; round their end
/// the truth's uncertainty as a band, and the 95 % interval as a whisker. Hidden from screen
/// readers: the row has the same figures as text. Empty unless the scale is above 0.
/// @throws InternalError for a number that is not finite
Html htmlErrorBar(const ErrorBar& bar);

/// Parts that the pages of a run share.

/// A part of a page under a heading of its own.
struct PageSection {
  std::string id;
  std::string title;      ///< what it answers
  Html content;           ///< where there is none, the page has neither section nor link
  Html hint = {};         ///< an answer in a few words, beside the link in the contents
  bool isFolded = false;  ///< only its heading is seen, until a reader opens it
};

/// A whole page: its header, the contents, the sections, and at its end the terms that it uses. Its
/// style is inside, and its own content policy forbids it to load anything but pictures that it
/// holds. One script is inside too, whose hash is in the policy, so that it alone may run; it opens
/// what a link leads to, and drives the viewer. Without it a reader can open everything by hand.
Html htmlPage(std::string_view title, const Html& header, const std::vector<PageSection>& sections);

/// Content that is seen once a reader opens it; nothing without any.
/// @param isOpen  at first
Html htmlFold(const Html& summary, const Html& content, bool isOpen = false);
Html htmlFold(std::string_view summary, const Html& content, bool isOpen = false);

/// A paragraph in small letters; nothing, if there is no text.
Html htmlNote(std::string_view text);

/// The plots of a section of a page, each under its title: of several the first is open, the others
/// are folded.
Html htmlPlots(std::span<const DrawnPlot> plots, std::string_view section);

/// Which methods the plots of a page show, and what their marks mean.
constexpr std::string_view plotReading =
    "At most eight methods: the flat horizon map, the method of the first claim, and the best of "
    "the others. A colour stands for a family of methods.";

/// A term and what it is, for a list <dl>; nothing, if there is no text.
Html htmlFact(std::string_view term, std::string_view text);

/// "1 method", "2 methods".
std::string plural(std::size_t count, std::string_view noun);

/// The tag that names the status of a run.
Html htmlStatus(study::RunStatus status);

/// One claim with its verdict, for the list of a section of claims.
/// @param study  whose claim it is; empty where that is clear
Html htmlClaim(const study::ClaimRecord& claim, const Html& study = {});

/// The section of a page's claims.
PageSection claimSection(std::span<const study::ClaimRecord> claims);
/// The same of lines that htmlClaim made.
PageSection claimSection(const Html& claims, const Html& hint = {});

/// The notices that stand before the figures, a paragraph each; those after the second are folded.
Html htmlNotices(const std::vector<std::string>& notices);

/// How a run is done again: its command, and facts about it.
PageSection reproduceSection(std::string_view command, const Html& facts = {});

/// The parts of a report page that are written in their own languages, in the folder `page`.

/// The style of all pages.
Html pageStyle();

/// The comparison of two pictures: the content of a section that is hidden until the script runs.
Html viewerMarkup();

/// The script of all pages.
Html pageScript();

/// Its SHA-256 as a content policy names it: 'sha256-…'.
Html pageScriptHash();

}  // namespace gnomon::report
