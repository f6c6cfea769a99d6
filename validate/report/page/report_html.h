#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/page/html_page.h"
#include "report/plots/gnuplot.h"
#include "report/tables/table.h"
#include "report/text/html.h"
#include "study/judge/ranking.h"
#include "study/record/record.h"

namespace gnomon::report {

/// "it is wrong at 1.2 % of the samples", or of a soft light "its share of the light is off by 1.2
/// %".
Html errorHtml(bool isSoft, std::optional<double> errorRate);

/// A picture of the opening.
struct OpeningFigure {
  std::string method;  ///< a label, or "truth"
  std::string role;    ///< "flat horizon map", "claimed and best"
};

/// At most four, of the first panel, in this order; a method of two roles stands once, one without
/// a picture there does not:
///   flat     the method that costs are compared with, costReference
///   claimed  the first method that a claim is about and that is neither flat nor the control
///            `unshadowed`
///   best     the first of the ranking that is not the control
///   truth
std::vector<OpeningFigure> openingFigures(const study::StudyRecord& record,
                                          const std::vector<study::RankedMethod>& ranked);

/// A run as one page that needs nothing beside it: style and pictures are inside, and its own
/// content policy forbids it to load anything. Of many cases the pictures have pages of their own
/// (casePages). In the order of a reader's questions: which method is best and how sure that is
/// (opening, ranking), where methods are wrong, what they cost, whether claims, thresholds and
/// references hold; then the pictures, and folded all that explains the figures.
/// @param folder  the run's folder: where the paths of the pictures start
/// @param plots   embedded, in this order
/// @throws InputError if a difference or the truth's mask cannot be read, InternalError if it is no
///   PNG, or for a number that is not finite
Html reportHtml(const study::StudyRecord& record, const std::filesystem::path& folder,
                std::span<const DrawnPlot> plots = {});

}  // namespace gnomon::report
