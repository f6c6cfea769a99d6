#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/page/html_page.h"
#include "report/text/html.h"
#include "study/judge/ranking.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The cases of a report, each a view under a light: its pictures and its tables. A single one
/// stands on the report's page; of up to eight the first is open there, the others are folded. Of
/// more, or where their pictures take more than 7.5 MB, each has a page of its own, so that any
/// report opens at once.

/// Whether the report's page itself has the pictures of its cases.
/// @param folder  the run's, where its pictures are
bool holdsPictures(const study::StudyRecord& record, const std::filesystem::path& folder);

/// The sections of the cases on the report's page. Of several, first a table of every method's
/// error in each, which leads to them.
/// @param folder  the run's, where its pictures are
/// @throws InputError, InternalError as panelFigures
std::vector<PageSection> caseSections(const study::StudyRecord& record,
                                      const std::vector<study::RankedMethod>& ranked,
                                      const std::filesystem::path& folder);

struct CasePage {
  std::string file;  ///< in the run's folder: "cases/camera_noon.html"
  Html page;         ///< needs nothing beside it
};

/// The pages of a report's cases; none where its own page has them.
/// @throws InputError, InternalError as panelFigures
std::vector<CasePage> casePages(const study::StudyRecord& record,
                                const std::filesystem::path& folder);

/// The section of the places where methods err most: of each shown method those that its picture
/// records, in the view and under the light where its error is largest, each beside the truth and
/// the difference from it; the worst one of each method is seen at once. A method that errs at the
/// places of one before it is only named there. Nothing without an error.
/// @throws InputError if a difference cannot be read
PageSection worstSection(const study::StudyRecord& record, const std::filesystem::path& folder);

}  // namespace gnomon::report
